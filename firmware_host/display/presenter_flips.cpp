// Presenter: the flips of pictures that were handed to the card.
#include "firmware_host/display/presenter.h"

#include <utility>

namespace frustumscreen::display {

void Presenter::take_ready_flips() {
    while (const std::optional<Flipped> flipped = device_.wait_flip(Nanoseconds(0))) {
        take(*flipped);
    }
}

bool Presenter::wait_until_shown() {
    wait_for_flip();
    return lit_ && lit_->shown && !queued_;
}

bool Presenter::read_shown(std::span<std::byte> rgba) const {
    return lit_ && lit_->shown && scanout_ &&
           scanout_->read(1 - (queued_ ? queued_->framebuffer : free_), rgba);
}

/// Waits only once for each flip: a card that hangs must not delay every frame.
void Presenter::wait_for_flip() {
    if (!queued_) {
        return;
    }
    if (!late_) {
        const MonotonicTime deadline = device_.now() + flip_timeout;
        while (queued_ && device_.now() < deadline) {
            if (const std::optional<Flipped> flipped = device_.wait_flip(deadline - device_.now())) {
                take(*flipped);
            }
        }
        if (queued_) {
            note_late();
        }
    }
    give_up_flip();
}

void Presenter::note_late() {
    late_ = true;
    state_ = {{DeviceHealth::Impaired, "display.late"},
              Sentence("the graphics card does not show the last picture; the exhibit waits for it")};
}

void Presenter::give_up_flip() {
    if (queued_ && device_.now() - queued_->at >= flip_given_up) {
        const MonotonicTime since = stuck_since_.value_or(queued_->at);
        lose("display.no_flip", "the graphics card does not answer; the projector will be lit again");
        try_again_ = device_.now();
        stuck_since_ = since;
    }
}

bool Presenter::takes_picture() {
    take_ready_flips();
    if (queued_ && !late_ && device_.now() - queued_->at >= flip_timeout) {
        note_late();
    }
    give_up_flip();
    return !queued_;
}

void Presenter::take(const Flipped& flipped) {
    if (!queued_ || flipped.ticket != queued_->ticket) {
        return; // the flip of a picture that was given up
    }
    if (flipped.answer != KmsAnswer::Done) {
        queued_.reset();
        late_ = false;
        flip_failed(flipped.answer);
        return;
    }
    if (device_.flips_keep_time()) {
        clock_.flipped(flipped.time);
    }
    free_ = 1 - queued_->framebuffer;
    queued_.reset();
    stuck_since_.reset();
    shown_before_.reset();
    const bool first = !std::exchange(lit_->shown, true);
    lit_->flips = !first;
    if (std::exchange(late_, false) || first || lit_->in_turn != device_.in_turn()) {
        say_lit();
    }
}

} // namespace frustumscreen::display
