/// Estimates the remaining time of a job with several stages from the expected time of each and the real time of the past ones.
///
/// Method   the running stage is extrapolated from its own progress. The stages to come take their expected time multiplied by a
///          factor: the geometric mean of the past stages' factors (real over expected time) and an additional 1. So one slow
///          stage, such as reading from a slow disk, slows the rest by the square root of its factor; several do so almost fully.
/// Units    seconds since any beginning; done: the share of the whole work, 0..1.
/// Threads  values; any.
#pragma once

#include <cstddef>
#include <vector>

namespace frustumscreen::programs {

class TimeLeft {
public:
    /// `ends`: of each stage, the share of the work that is done when it ends; ascending, the last is 1.
    TimeLeft(std::vector<double> ends, double expected_s);
    /// Call when the share `done` of the work is done at `now_s`; both grow from call to call.
    void report(double now_s, double done);
    [[nodiscard]] double seconds(double now_s) const;

private:
    /// Logarithms of the factors by which stages took longer than expected.
    struct Factors {
        double sum = 0.0;
        double count = 0.0;
        void add(double factor, double weight);
        [[nodiscard]] double mean() const; ///< geometric, with an additional 1
    };
    [[nodiscard]] double begin() const { return stage_ == 0 ? 0.0 : ends_[stage_ - 1]; }
    [[nodiscard]] double expected() const { return (ends_[stage_] - begin()) * expected_s_; }

    std::vector<double> ends_;
    double expected_s_;
    std::size_t stage_ = 0;
    double stage_begin_s_ = 0.0;
    double reported_s_ = 0.0; ///< when `done_` was reported
    double done_ = 0.0;
    Factors passed_;
};

} // namespace frustumscreen::programs
