/// How long a run of several steps still takes.
///
/// Method   a step's seconds are what has passed in it over the share that is done; of a step to come, those
///          of the last one of its kind, else as many as its guess is to the guesses of all that is known.
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

    /// Step `name` is done by this share (0..1); it begins when it is named after another one. Steps before
    /// it count as done. The time left of a step that was not planned is its own alone. Nothing while nothing
    /// is known.
    [[nodiscard]] std::optional<double> at(const std::string& name, double done, double now_s);

private:
    struct Known {
        WorkStep step;
        std::optional<double> takes_s;
    };
    [[nodiscard]] std::optional<double> expected_s(const WorkStep& step) const;

    std::vector<Known> steps_; ///< the planned ones first
    std::size_t planned_ = 0;
    std::optional<std::size_t> current_;
    double begun_s_ = 0.0; ///< the current one
};

/// As a person says it: '40 s', '4 min', '2 h 5 min'.
[[nodiscard]] std::string words_of_time(double seconds);

} // namespace frustumscreen
