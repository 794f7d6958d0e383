#include "firmware_host/display/presenter.h"

#include "firmware_host/base/format_sentence.h"
#include "firmware_host/display/output_sentence.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace frustumscreen::display {

namespace {

constexpr Nanoseconds soon = std::chrono::milliseconds(50);
constexpr std::string_view projector_is_elsewhere =
    "a projector is at another graphics card; the exhibit must be restarted to use it";

DeviceState asleep() {
    return {{DeviceHealth::Well, "display.asleep"}, Sentence("the projector is dark on purpose")};
}

} // namespace

Presenter::Presenter(KmsDevice& device, MakeScanout make_scanout, OutputRequest request)
    : device_(device), make_scanout_(std::move(make_scanout)),
      request_(std::move(request)), state_{{DeviceHealth::Away, "display.looked_for"},
                                           Sentence("the projector is being looked for")} {}

void Presenter::connected(CardSeen seen) {
    seen_ = std::move(seen);
    looked_ = true;
    try_again_.reset();
    unfit_.clear();
    if (seen_.state == CardState::Elsewhere) {
        lose("display.elsewhere", projector_is_elsewhere);
    } else if (seen_.state != CardState::There) {
        lose_card();
    } else if (lit_ && !still_right()) {
        darken_ = true;
    } else if (!lit_) {
        state_ = sleep_ != Sleep::None ? asleep() : why_dark(seen_, request_);
    }
}

Result<void> Presenter::check_card() {
    if (seen_.state == CardState::Back) {
        return fail(ErrorKind::DeviceLost, "display.card_again",
                    "display: the graphics card is there again; the exhibit must be restarted "
                    "to use it");
    }
    if (seen_.state == CardState::Elsewhere) {
        return fail(ErrorKind::DeviceLost, "display.projector_elsewhere", "display: {}",
                    projector_is_elsewhere);
    }
    return {};
}

/// A picture is due, so the projector is lit with it.
void Presenter::wake() {
    if (sleep_ != Sleep::None) {
        sleep_ = Sleep::None;
        try_again_.reset();
        stuck_since_.reset();
        if (lit_) {
            say_lit();
        } else {
            state_ = why_dark(seen_, request_);
        }
    }
}

Result<void> Presenter::stay_dark(bool may_set) {
    TRY_VOID(check_card());
    if (sleep_ == Sleep::None) {
        sleep_ = Sleep::Wanted;
        try_again_.reset();
    }
    take_ready_flips();
    wait_for_flip();
    const bool may_try = !(try_again_ && device_.now() < *try_again_);
    if (sleep_ == Sleep::Wanted && seen_.state == CardState::There && !queued_ && may_set && may_try) {
        darken();
    }
    return {};
}

Result<MonotonicTime> Presenter::present(const PixelRectangle& changed, bool may_set) {
    TRY_VOID(check_card());
    wake();
    if (stuck_since_ && device_.now() - *stuck_since_ >= stuck_given_up) {
        stuck_since_.reset();
        if (choose_connector(seen_, request_) != nullptr) {
            return fail(ErrorKind::DeviceLost, "display.stuck",
                        "display: the graphics card has taken no picture for {} s; the exhibit "
                        "must be restarted",
                        stuck_given_up / std::chrono::seconds(1));
        }
    }
    for (PixelRectangle& stale : stale_) {
        stale = united(stale, changed);
    }
    take_ready_flips();
    wait_for_flip();
    if (seen_.state == CardState::There && !queued_) {
        if (darken_ && may_set) {
            darken();
        }
        if (lit_ && !darken_) {
            flip();
        } else if (!lit_ && may_set && !(try_again_ && device_.now() < *try_again_)) {
            light();
        }
    }
    if (!queued_) {
        return device_.now();
    }
    // In turn, the flip for the next refresh is already queued.
    const Nanoseconds ahead = device_.in_turn() ? clock_.period() : Nanoseconds(0);
    const MonotonicTime expected = clock_.first_after(device_.now() + ahead);
    if (const std::optional<Flipped> flipped = device_.wait_flip(Nanoseconds(0))) {
        take(*flipped);
        return queued_ ? expected : flipped->time; // an emulated card's flip comes at once
    }
    return expected;
}

bool Presenter::still_right() const {
    const auto connector =
        std::find_if(seen_.connectors.begin(), seen_.connectors.end(),
                     [this](const ConnectorSeen& seen) { return seen.id == lit_->connector; });
    if (connector == seen_.connectors.end() || connector->link_bad ||
        lit_->blindly != is_lit_blindly(*connector, request_) ||
        (connector->plugged == Plugged::No && !lit_->blindly)) {
        return false;
    }
    if (connector->plugged == Plugged::Unknown && choose_connector(seen_, request_) != &*connector) {
        return false;
    }
    const std::vector<ModeTiming> modes = modes_to_try(*connector, request_);
    if (!modes.empty() && fulfils(modes.front(), request_) && !lit_->as_requested) {
        return false; // the requested mode has become possible
    }
    return std::find(modes.begin(), modes.end(), lit_->mode) != modes.end();
}

void Presenter::darken() {
    const KmsAnswer answer = device_.darken();
    if (answer == KmsAnswer::Busy) {
        went_wrong(answer);
        return; // retried with the next picture
    }
    if (answer == KmsAnswer::Refused && sleep_ != Sleep::None) {
        try_again_ = device_.now() + between_tries; // it is still lit
        return;
    }
    stuck_since_.reset();
    lit_.reset();
    darken_ = false;
    clock_ = {};
    if (answer != KmsAnswer::Done && answer != KmsAnswer::Refused) {
        went_wrong(answer);
    } else if (sleep_ != Sleep::None) {
        sleep_ = Sleep::Dark;
        state_ = asleep();
    } else {
        state_ = why_dark(seen_, request_);
    }
}

void Presenter::light() {
    const ConnectorSeen* connector = choose_connector(seen_, request_);
    if (connector == nullptr) {
        return;
    }
    try_again_ = device_.now() + between_tries;
    if (!master_ && !device_.become_master()) {
        return;
    }
    master_ = true;
    for (const ModeTiming& mode : modes_to_try(*connector, request_)) {
        const bool unfit = std::find(unfit_.begin(), unfit_.end(), mode) != unfit_.end();
        if (!unfit && light(*connector, mode)) {
            return;
        }
    }
    unfit_.clear();
    state_ = why_refused(*connector, request_, no_memory_.view());
}

/// Returns false after a failure if another mode may work.
bool Presenter::light(const ConnectorSeen& connector, const ModeTiming& mode) {
    const PixelSize picture{request_.picture_width, request_.picture_height};
    const PixelSize screen{mode.width, mode.height};
    const bool has_size = picture.width > 0 && picture.height > 0;
    if (has_size && card_scales_ && !(picture == screen)) {
        if (light(connector, mode, picture)) {
            return true;
        }
        card_scales_ = false; // or the card refuses the mode itself; the copy can scale too
    }
    return light(connector, mode, screen);
}

bool Presenter::light(const ConnectorSeen& connector, const ModeTiming& mode, PixelSize size) {
    if (!make_scanout(framebuffer_for(size))) {
        return false;
    }
    const PixelRectangle place = letterbox(size, {mode.width, mode.height});
    const KmsAnswer answer = device_.light(connector.id, mode, {fill(), size, place}, ++ticket_);
    if (answer == KmsAnswer::Done) {
        const bool as_requested = request_.width == 0 || fulfils(mode, request_) ||
                                  (request_.force && mode == modes_to_try(connector, request_).front());
        lit_ = Lit{.connector = connector.id,
                   .name = connector.name,
                   .mode = mode,
                   .as_requested = as_requested,
                   .blindly = is_lit_blindly(connector, request_)};
        queued_ = Queued{device_.now(), ticket_, free_};
        clock_ = FlipClock(refresh_hz(mode));
        state_ = {{DeviceHealth::Well, "display.first_picture"},
                  format_sentence("the projector at {} is about to be lit", connector.name)};
        return true;
    }
    if (answer == KmsAnswer::Refused) {
        return false;
    }
    went_wrong(answer);
    return true;
}

void Presenter::flip() {
    const KmsAnswer answer = device_.flip(fill(), ++ticket_);
    if (answer == KmsAnswer::Done) {
        queued_ = Queued{device_.now(), ticket_, free_};
        return;
    }
    flip_failed(answer);
}

void Presenter::flip_failed(KmsAnswer answer) {
    if (answer == KmsAnswer::Refused && !lit_->flips) {
        if (scanout_->size() == framebuffer_for({lit_->mode.width, lit_->mode.height})) {
            unfit_.push_back(lit_->mode);
        } else {
            card_scales_ = false;
        }
    }
    went_wrong(answer);
}

PixelSize Presenter::framebuffer_for(PixelSize size) const {
    return {size.width, size.height * stacked(request_.eyes)};
}

bool Presenter::make_scanout(PixelSize size) {
    if (scanout_ && scanout_->size() == size) {
        return true;
    }
    Result<std::unique_ptr<ScanoutPair>> made = make_scanout_(size);
    if (!made) {
        no_memory_ = Sentence(made.error().message);
        return false;
    }
    no_memory_ = {};
    if (!shown_before_) {
        shown_before_ = std::move(scanout_);
    }
    scanout_ = std::move(*made);
    const PixelSize picture = framebuffer_for({request_.picture_width, request_.picture_height});
    stale_.fill({.x = 0, .y = 0, .width = picture.width, .height = picture.height});
    return true;
}

FramebufferId Presenter::fill() {
    PixelRectangle& stale = stale_.at(static_cast<std::size_t>(free_));
    return scanout_->fill(free_, std::exchange(stale, {}));
}

void Presenter::went_wrong(KmsAnswer answer) {
    switch (answer) {
    case KmsAnswer::Done:
        break;
    case KmsAnswer::Busy: // skip this picture; the next one comes
        try_again_ = device_.now() + soon;
        stuck_since_ = stuck_since_.value_or(device_.now());
        break;
    case KmsAnswer::Refused:
        lose("display.picture_refused",
             "the graphics card refused a picture; the projector will be lit again");
        try_again_ = device_.now() + soon;
        break;
    case KmsAnswer::NotMaster:
        lose("display.held_by_another",
             "another program holds the screen; the exhibit goes on in the dark until it lets go");
        master_ = false;
        break;
    case KmsAnswer::Gone:
        lose_card();
        break;
    }
}

void Presenter::lose_card() {
    lose("display.card_gone", "the graphics card is gone; the exhibit goes on in the dark");
}

void Presenter::lose(MessageId id, std::string_view why) {
    lit_.reset();
    if (queued_) {
        free_ = 1 - queued_->framebuffer; // the card took the flip: only its report is missing
        queued_.reset();
    }
    late_ = false;
    darken_ = false;
    clock_ = {};
    stuck_since_.reset();
    try_again_ = device_.now() + between_tries;
    state_ = {{DeviceHealth::Away, id}, Sentence(why)};
}

void Presenter::say_lit() {
    lit_->in_turn = device_.in_turn();
    state_ = state_of({.connector = lit_->name,
                       .mode = lit_->mode,
                       .as_requested = lit_->as_requested,
                       .blindly = lit_->blindly,
                       .shortcoming = device_.shortcoming(),
                       .eyes = request_.eyes,
                       .in_turn = lit_->in_turn,
                       .card = device_.card()});
}

} // namespace frustumscreen::display
