#include "app/bench/measures/time_left.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace frustumscreen::bench {

namespace {
constexpr double min_share = 0.02; ///< share of a step below which its duration is unknown
}

TimeLeft::TimeLeft(std::vector<WorkStep> steps) : planned_(steps.size()) {
    for (WorkStep& step : steps) {
        steps_.push_back({std::move(step), {}});
    }
}

std::optional<double> TimeLeft::update(const std::string& name, double done, double now_s) {
    const auto found = std::find_if(steps_.begin(), steps_.end(),
                                    [&name](const Known& known) { return known.step.name == name; });
    const auto index = static_cast<std::size_t>(found - steps_.begin());
    if (found == steps_.end()) {
        steps_.push_back({{name, name, 1.0}, {}});
    }
    Known& step = steps_[index];
    if (current_ != index) {
        current_ = index;
        begun_s_ = now_s;
        step.takes_s.reset();
    }
    const double passed_s = now_s - begun_s_;
    if (done >= min_share) {
        step.takes_s = passed_s / std::min(done, 1.0);
    }
    const bool planned = index < planned_;
    const std::optional<double> takes_s = step.takes_s || !planned ? step.takes_s : expected_s(step.step);
    if (!takes_s) {
        return std::nullopt;
    }
    double left_s = std::fmax(0.0, *takes_s - passed_s);
    for (std::size_t later = index + 1; later < planned_; ++later) {
        left_s += expected_s(steps_[later].step).value_or(0.0);
    }
    return left_s;
}

std::optional<double> TimeLeft::expected_s(const WorkStep& step) const {
    std::optional<double> of_kind_s;
    double known_s = 0.0;
    double known_guess = 0.0;
    for (const Known& known : steps_) {
        if (!known.takes_s) {
            continue;
        }
        known_s += *known.takes_s;
        known_guess += known.step.guess;
        if (known.step.kind == step.kind) {
            of_kind_s = *known.takes_s * step.guess / known.step.guess;
        }
    }
    if (of_kind_s || known_guess <= 0.0) {
        return of_kind_s;
    }
    return known_s * step.guess / known_guess;
}

} // namespace frustumscreen::bench
