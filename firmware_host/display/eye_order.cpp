#include "firmware_host/display/eye_order.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::display {

namespace {

/// After this time the report of a flip counts as lost: twelve refreshes of 120 Hz.
constexpr Nanoseconds lost_after = std::chrono::milliseconds(100);
constexpr Nanoseconds busy_pause = std::chrono::milliseconds(1);

} // namespace

KmsAnswer EyeOrder::light(std::uint32_t connector, const ModeTiming& mode, const ScannedOut& shown,
                          std::uint64_t ticket) {
    stopped_ = true;
    next_.reset();
    take_flips();
    const KmsAnswer answer = card_.light(connector, mode, shown, ticket_ + 1);
    if (answer == KmsAnswer::Done) {
        ++ticket_;
        period_ = Nanoseconds(std::llround(1e9 / refresh_hz(mode)));
        right_row_ = shown.size.height;
        queued_ = Queued{.picture = {shown.framebuffer, ticket}, .first_row = 0, .at = card_.now()};
        shown_.reset();
        news_.reset();
        not_before_.reset();
        failed_ = KmsAnswer::Done;
        refusals_ = 0;
        stopped_ = right_shown_ = false;
    }
    return answer;
}

KmsAnswer EyeOrder::flip(FramebufferId shown, std::uint64_t ticket) {
    if (failed_ != KmsAnswer::Done) {
        return std::exchange(failed_, KmsAnswer::Done);
    }
    next_ = Picture{shown, ticket};
    next_since_ = card_.now();
    stopped_ = false;
    const KmsAnswer answer = flip_on();
    if (answer != KmsAnswer::Done) {
        next_.reset();
    }
    return answer;
}

KmsAnswer EyeOrder::darken() {
    stopped_ = true;
    take_flips();
    return card_.darken();
}

void EyeOrder::turn() {
    take_flips();
    const KmsAnswer answer = flip_on();
    if (answer == KmsAnswer::Done) {
        return;
    }
    if (next_ && !next_is_taken()) {
        news_ = Flipped{.time = card_.now(), .ticket = next_->ticket, .answer = answer};
        next_.reset();
    } else {
        failed_ = answer; // the next picture may be shown yet
    }
}

bool EyeOrder::next_is_taken() const {
    return next_ && queued_ && queued_->picture.ticket == next_->ticket;
}

MonotonicTime EyeOrder::due() const {
    if (not_before_ && shown_ && !stopped_) {
        return *not_before_;
    }
    return (queued_ && !stopped_ ? queued_->at : card_.now()) + lost_after;
}

std::optional<Flipped> EyeOrder::next_shown() {
    return std::exchange(news_, std::nullopt);
}

void EyeOrder::take_flips() {
    while (const std::optional<Flipped> flipped = card_.wait_flip(Nanoseconds(0))) {
        take(*flipped);
    }
}

void EyeOrder::take(const Flipped& flipped) {
    if (!queued_ || flipped.ticket != ticket_) {
        return; // its report counted as lost
    }
    const Queued done = *std::exchange(queued_, std::nullopt);
    last_ = flipped;
    not_before_.reset();
    right_shown_ = right_shown_ || done.first_row > 0;
    if (shown_ && shown_->ticket == done.picture.ticket) {
        return;
    }
    shown_ = done.picture;
    news_ = Flipped{.time = flipped.time, .ticket = done.picture.ticket, .refresh = flipped.refresh};
    if (next_ && next_->ticket == done.picture.ticket) {
        next_.reset();
    }
}

KmsAnswer EyeOrder::flip_on() {
    const MonotonicTime now = card_.now();
    const bool waits = queued_ && now - queued_->at < lost_after;
    if (!shown_ || stopped_ || waits || (not_before_ && now < *not_before_)) {
        return KmsAnswer::Done;
    }
    not_before_.reset();
    const bool turns = in_turn();
    const std::optional<int> row = turns ? next_row(now) : std::optional<int>(0);
    if (!row || (!turns && !next_)) {
        return KmsAnswer::Done;
    }
    const Picture picture = next_.value_or(*shown_);
    const KmsAnswer answer = turns ? card_.flip_from(*row, picture.framebuffer, ticket_ + 1)
                                   : card_.flip(picture.framebuffer, ticket_ + 1);
    if (answer == KmsAnswer::Done) {
        ++ticket_;
        queued_ = Queued{.picture = picture, .first_row = *row, .at = now};
    } else if (answer == KmsAnswer::Busy) {
        not_before_ = now + busy_pause;
        const bool too_long = next_ && !next_is_taken() && now - next_since_ >= lost_after;
        return too_long ? answer : KmsAnswer::Done;
    } else if (answer == KmsAnswer::Refused && turns && !right_shown_) {
        ++refusals_; // the left eye's picture stays
        not_before_ = now + busy_pause;
    } else {
        stopped_ = true;
        return answer;
    }
    return KmsAnswer::Done;
}

/// The refreshes since the last flip are counted by its time. A commit takes effect at a refresh only if it comes some
/// time before.
std::optional<int> EyeOrder::next_row(MonotonicTime now) {
    const auto passed = std::max<Nanoseconds::rep>((now - last_.time) / period_, 0);
    const MonotonicTime next = last_.time + (passed + 1) * period_;
    if (next - now < period_ / 4) {
        not_before_ = next + period_ / 16;
        return std::nullopt;
    }
    const auto number = last_.refresh + static_cast<std::uint64_t>(passed) + 1;
    return number % 2 == 0 ? 0 : right_row_;
}

} // namespace frustumscreen::display
