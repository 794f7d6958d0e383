#include "app/watch/judge.h"

#include <algorithm>

namespace frustumscreen::watch {

Judge::Judge(const Timeouts& timeouts, MonotonicTime start)
    : timeouts_(timeouts), looked_(start), counted_(start), judged_since_(start), drained_(start) {}

void Judge::restart(MonotonicTime now) {
    judged_since_ = counted_ = now;
    has_lived_ = false;
    bad_since_.fill(std::nullopt);
}

void Judge::step_taken(MonotonicTime now) {
    restart(now);
    endings_ = 0.0;
}

void Judge::count_endings(MonotonicTime now, std::uint32_t failures) {
    const double dropped = to_seconds(now - drained_) / to_seconds(timeouts_.between_endings);
    endings_ = std::max(endings_ - dropped, 0.0);
    drained_ = now;
    endings_ += failures_ && failures > *failures_ ? failures - *failures_ : 0;
    failures_ = failures;
}

bool Judge::picture_lives(MonotonicTime now, const Outcome& outcome) {
    if (outcome.process != process_ && outcome.process != 0) {
        judged_since_ = counted_ = process_since_ = now;
        has_lived_ = false;
    }
    process_ = outcome.process;
    const std::optional<ExhibitSays>& says = outcome.exhibit;
    if (outcome.process == 0 || !says || says->age > fresh_for || now - says->age < process_since_ ||
        !says->well) {
        return false;
    }
    if (says->pictures != pictures_ || says->asleep) {
        pictures_ = says->pictures;
        counted_ = now;
    }
    return now - counted_ < fresh_for;
}

bool Judge::lasts(Cause cause, bool bad, MonotonicTime now, Nanoseconds duration) {
    std::optional<MonotonicTime>& since = bad_since_.at(static_cast<std::size_t>(cause));
    if (!bad) {
        since.reset();
        return false;
    }
    since = since ? since : now;
    return now - *since >= duration;
}

std::optional<Cause> Judge::trouble_of(MonotonicTime now, const Outcome& outcome, bool lives) {
    const bool ends = endings_ > max_endings;
    // A start takes longer than an interruption of a live picture.
    const MonotonicTime given = has_lived_ ? now : judged_since_ + timeouts_.start;
    const bool dark = lasts(Cause::NoPicture, !lives, now, timeouts_.picture) && now >= given;
    const bool empty =
        lasts(Cause::NothingToShow, lives && outcome.exhibit->artifacts == 0, now, timeouts_.nothing_to_show);
    const bool is_short =
        outcome.memory_free < min_memory_free || outcome.exhibit_memory > max_exhibit_memory;
    const bool memory = lasts(Cause::MemoryShort, is_short, now, timeouts_.memory);
    const bool device =
        lasts(Cause::DeviceSilent, lives && outcome.exhibit->device_hangs, now, timeouts_.device);
    if (ends && !lives) {
        return Cause::KeepsEnding;
    }
    return dark     ? std::optional(Cause::NoPicture)
           : empty  ? std::optional(Cause::NothingToShow)
           : memory ? std::optional(Cause::MemoryShort)
           : device ? std::optional(Cause::DeviceSilent)
                    : std::nullopt;
}

Observation Judge::look(MonotonicTime now, Mode mode, const Outcome& outcome) {
    if (now - looked_ > late_look) {
        restart(now);
    }
    looked_ = now;
    count_endings(now, outcome.failures);
    if (mode == Mode::Safe) {
        // Without a projector the safe picture is not needed, and a reboot does not help.
        if (outcome.projector == false || (outcome.safe_pictures && *outcome.safe_pictures != pictures_)) {
            pictures_ = outcome.safe_pictures.value_or(pictures_);
            counted_ = now;
        }
        const bool dead = now - counted_ >= timeouts_.safe_picture;
        return {dead ? std::optional(Cause::SafePictureFails) : std::nullopt, false};
    }
    const bool lives = picture_lives(now, outcome);
    has_lived_ = has_lived_ || lives;
    return {trouble_of(now, outcome, lives), lives};
}

} // namespace frustumscreen::watch
