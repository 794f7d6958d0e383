/// How long a run of several steps still takes.
///
/// Method   the current step's seconds are the time passed in it over the share that is done. A step to come
///          takes its guess, scaled by the seconds over the guess of the last known step of its kind, else of
///          all known steps together.
/// Units    seconds; guesses only count in relation to each other.
/// Threads  values; any. Reads no clock.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen {

struct WorkStep {
    std::string name; ///< unique
    std::string kind;
    double guess = 1.0;
};

class TimeLeft {
public:
    TimeLeft() = default;
    explicit TimeLeft(std::vector<WorkStep> steps);

    /// Takes the share (0..1) of step `name` that is done; returns the seconds left of the run, or of this
    /// step alone if it was not planned. A step begins when it is named after another one; the steps before
    /// it count as done. Returns nothing while nothing is known.
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
    double begun_s_ = 0.0; ///< when the current step began
};

} // namespace frustumscreen
