/// A tracker that replays poses, normally of a pose file, at their own speed or another.
///
/// Time     the first sample comes at `start`; with `repeat` the recording begins again one step after its
///          end. If a late poll makes more than `max_rounds_samples` samples of repeated rounds due, whole
///          rounds are skipped: a recording of a few microseconds would fill the memory.
/// Threads  one caller.
#pragma once

#include "firmware_host/tracker/tracker.h"

#include <vector>

namespace frustumscreen::tracker {

class ReplayTracker final : public Tracker {
public:
    static constexpr std::size_t max_rounds_samples = 16384;

    /// Samples in any order; they are sorted by time.
    ReplayTracker(std::vector<PoseSample> samples, MonotonicTime start, bool repeat, double speed = 1.0);

    [[nodiscard]] Result<void> poll(MonotonicTime now, std::vector<PoseSample>& samples) override;
    [[nodiscard]] std::string name() const override { return "replay"; }
    [[nodiscard]] std::string_view state() const override {
        return "poses come from a file; no tracker is used";
    }

private:
    void skip_rounds(MonotonicTime now);

    std::vector<PoseSample> recording_;
    Nanoseconds shift_{0};  ///< from the recording's clock to ours
    Nanoseconds length_{0}; ///< of one round; 0 = no repetition
    std::size_t next_ = 0;
};

} // namespace frustumscreen::tracker
