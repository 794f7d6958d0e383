#include "firmware_host/tracker/replay_tracker.h"

#include "firmware_host/tracker/replay_speed.h"

#include <algorithm>

namespace frustumscreen::tracker {

ReplayTracker::ReplayTracker(std::vector<PoseSample> samples, MonotonicTime start, bool repeat, double speed)
    : recording_(std::move(samples)) {
    if (recording_.empty()) {
        return;
    }
    std::stable_sort(recording_.begin(), recording_.end(),
                     [](const PoseSample& a, const PoseSample& b) { return a.time < b.time; });
    if (speed != 1.0) {
        const MonotonicTime first = recording_.front().time;
        for (PoseSample& sample : recording_) {
            sample.time = first + scaled(sample.time - first, 1.0 / speed);
        }
    }
    shift_ = start - recording_.front().time;
    if (repeat) {
        // The next round begins one mean step after the last sample; a single pose repeats once a second.
        const Nanoseconds span = recording_.back().time - recording_.front().time;
        const auto steps = static_cast<Nanoseconds::rep>(std::max<std::size_t>(recording_.size() - 1, 1));
        length_ = span > Nanoseconds::zero() ? span + std::max(span / steps, Nanoseconds(1))
                                             : std::chrono::seconds(1);
    }
}

/// Skips whole rounds that became due at once between two polls.
void ReplayTracker::skip_rounds(MonotonicTime now) {
    constexpr auto max_at_once = static_cast<Nanoseconds::rep>(max_rounds_samples);
    if (recording_.empty() || length_ <= Nanoseconds::zero()) {
        return;
    }
    const Nanoseconds::rep rounds = (now - (recording_.front().time + shift_)) / length_;
    if (rounds > 1 && rounds > max_at_once / static_cast<Nanoseconds::rep>(recording_.size())) {
        shift_ += (rounds - 1) * length_;
        next_ = 0;
    }
}

Result<void> ReplayTracker::poll(MonotonicTime now, std::vector<PoseSample>& samples) {
    skip_rounds(now);
    while (next_ < recording_.size() && recording_[next_].time + shift_ <= now) {
        PoseSample sample = recording_[next_];
        sample.time += shift_;
        samples.push_back(sample);
        if (++next_ == recording_.size() && length_ > Nanoseconds::zero()) {
            next_ = 0;
            shift_ += length_;
        }
    }
    return {};
}

} // namespace frustumscreen::tracker
