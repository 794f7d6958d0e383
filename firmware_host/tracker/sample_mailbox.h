/// The latest samples on their way from a device's thread to the exhibit's; the oldest give way.
///
/// Threads  one puts, one takes. Taking never waits: while the other side is putting, nothing is there yet.
/// Memory   fixed.
#pragma once

#include "firmware_host/tracker/tracker.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <span>

namespace frustumscreen {

class SampleMailbox {
public:
    static constexpr std::size_t capacity = 256;

    void put(std::span<const PoseSample> samples) {
        const std::lock_guard lock(mutex_);
        for (const PoseSample& sample : samples) {
            samples_[put_ % capacity] = sample;
            ++put_;
        }
        taken_ = put_ > capacity ? std::max(taken_, put_ - capacity) : taken_;
    }
    /// Appends those with time <= now that were not taken before.
    void take(MonotonicTime now, std::vector<PoseSample>& samples) {
        const std::unique_lock lock(mutex_, std::try_to_lock);
        while (lock.owns_lock() && taken_ < put_ && samples_[taken_ % capacity].time <= now) {
            samples.push_back(samples_[taken_ % capacity]);
            ++taken_;
        }
    }

private:
    std::mutex mutex_;
    std::array<PoseSample, capacity> samples_;
    std::uint64_t put_ = 0;   ///< ever
    std::uint64_t taken_ = 0; ///< ever, or overwritten
};

} // namespace frustumscreen
