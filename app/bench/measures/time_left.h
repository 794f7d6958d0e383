/// Remaining time of a run of several steps.
///
/// Method   the current step's duration is the time spent in it over the completed share. A future step takes
///          its guess, scaled by the ratio of duration to guess of the last known step of its kind, or else
///          of all known steps together.
/// Units    seconds; only the ratios of guesses matter.
/// Threads  values; any. Reads no clock.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::bench {

struct WorkStep {
    std::string name; ///< unique
    std::string kind;
    double guess = 1.0;
};

class TimeLeft {
public:
    TimeLeft() = default;
    explicit TimeLeft(std::vector<WorkStep> steps);

    /// Takes the completed share (0..1) of step `name`; returns the remaining seconds of the run, or of this
    /// step alone if it was not planned. A step begins when `name` differs from the previous call's; the
    /// steps before it count as done. Returns nullopt until a duration is known.
    [[nodiscard]] std::optional<double> update(const std::string& name, double done, double now_s);

private:
    struct Known {
        WorkStep step;
        std::optional<double> takes_s;
    };
    [[nodiscard]] std::optional<double> expected_s(const WorkStep& step) const;

    std::vector<Known> steps_; ///< the planned ones first
    std::size_t planned_ = 0;
    std::optional<std::size_t> current_;
    double begun_s_ = 0.0; ///< start of the current step
};

} // namespace frustumscreen::bench
