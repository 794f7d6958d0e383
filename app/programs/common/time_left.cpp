#include "app/programs/common/time_left.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::programs {

void TimeLeft::Factors::add(double factor, double weight) {
    constexpr double least = 1e-3; // a stage that had nothing to do
    sum += weight * std::log(std::max(factor, least));
    count += weight;
}

double TimeLeft::Factors::mean() const {
    return std::exp(sum / (count + 1.0));
}

TimeLeft::TimeLeft(std::vector<double> ends, double expected_s)
    : ends_(std::move(ends)), expected_s_(expected_s) {}

void TimeLeft::report(double now_s, double done) {
    constexpr double rounding = 1e-9;
    std::size_t stage = stage_;
    while (stage + 1 < ends_.size() && done >= ends_[stage] - rounding) {
        ++stage;
    }
    if (stage > stage_) {
        passed_.add((now_s - stage_begin_s_) / expected(), 1.0); // skipped stages do not count
        stage_ = stage;
        stage_begin_s_ = now_s;
    }
    if (done != done_) {
        reported_s_ = now_s;
        done_ = done;
    }
}

double TimeLeft::seconds(double now_s) const {
    constexpr double some = 0.05;
    constexpr double overdue = 0.3; // of the time that an overdue stage has taken
    const double elapsed_s = now_s - stage_begin_s_;
    const double share = (done_ - begin()) / (ends_[stage_] - begin());
    Factors factors = passed_;
    double stage_s = expected() * passed_.mean();
    if (share > some) {
        stage_s = (reported_s_ - stage_begin_s_) / share;
        factors.add(stage_s / expected(), share);
    } else if (elapsed_s > stage_s) {
        factors.add(elapsed_s / expected(), 1.0);
    }
    const double rest_s = elapsed_s > stage_s ? overdue * elapsed_s : stage_s - elapsed_s;
    return rest_s + (1.0 - ends_[stage_]) * expected_s_ * factors.mean();
}

} // namespace frustumscreen::programs
