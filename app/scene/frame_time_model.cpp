#include "app/scene/frame_time_model.h"

#include "app/geometry/time_curves.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen {

namespace {

/// Limit of |log|: larger than any real change of a GPU's speed. It keeps a run of bad values from ending in
/// infinity.
constexpr double most_log = 7.0;

double bounded(double logarithm) {
    return std::clamp(logarithm, -most_log, most_log);
}

/// A frame that draws hardly anything says little about the others, so relative work is limited to a factor
/// of 20.
double relative(double work, double at_start) {
    constexpr double most = 20.0;
    return std::isfinite(work) && work > 0.0 && at_start > 0.0 ? std::clamp(work / at_start, 1.0 / most, most)
                                                               : 1.0;
}

} // namespace

bool FrameTimeModel::is_time(double ms) {
    return ms > 0.0 && ms <= longest_ms; // false for NaN
}

FrameTimeModel::FrameTimeModel(const std::vector<RungTime>& rungs) {
    for (const RungTime& start : rungs) {
        rungs_.push_back({start});
        if (!is_time(start.ms)) {
            rungs_.back().start.ms = std::numeric_limits<double>::infinity();
        }
    }
    fit_shares();
}

double RungCost::ms(const FrameWork& work, int samples) const {
    return fixed_ms + ms_per_triangle * std::fmax(work.triangles, 0.0) +
           ms_per_sample * std::fmax(work.pixels, 0.0) * samples;
}

namespace {

/// Fit over the levels that are drawn in this way. A small ridge term helps where they cannot separate the
/// terms.
RungCost cost_of(const std::vector<RungTime>& rungs, bool relief, bool on_gpu) {
    const auto is_alike = [=](const RungTime& rung) {
        return rung.relief == relief && rung.on_gpu == on_gpu;
    };
    glm::dvec3 most(1.0, 0.0, 0.0);
    const auto terms = [](const RungTime& start) {
        return glm::dvec3(1.0, std::fmax(start.work.triangles, 0.0),
                          std::fmax(start.work.pixels, 0.0) * start.samples);
    };
    for (const RungTime& rung : rungs) {
        most = is_alike(rung) ? glm::max(most, terms(rung)) : most;
    }
    const glm::dvec3 scale(1.0, most.y > 0.0 ? 1.0 / most.y : 0.0, most.z > 0.0 ? 1.0 / most.z : 0.0);
    glm::dmat3 normal(0.0);
    glm::dvec3 right(0.0);
    for (const RungTime& rung : rungs) {
        if (is_alike(rung) && FrameTimeModel::is_time(rung.ms)) {
            const glm::dvec3 row = terms(rung) * scale / rung.ms;
            normal += glm::outerProduct(row, row);
            right += row;
        }
    }
    const double trace = normal[0][0] + normal[1][1] + normal[2][2];
    if (!(trace > 0.0)) {
        return {};
    }
    const glm::dvec3 cost =
        scale * glm::max(glm::inverse(normal + glm::dmat3(1e-4 * trace)) * right, glm::dvec3(0.0));
    return {cost.x, cost.y, cost.z};
}

} // namespace

FrameCost cost_of(const std::vector<RungTime>& rungs) {
    return {cost_of(rungs, false, false), cost_of(rungs, true, false), cost_of(rungs, true, true)};
}

double FrameCost::ms(const RungTime& rung) const {
    return of(rung).ms(rung.work, rung.samples);
}

void FrameTimeModel::fit_shares() {
    std::vector<RungTime> starts;
    for (const Rung& rung : rungs_) {
        starts.push_back(rung.start);
    }
    const FrameCost costs = cost_of(starts);
    for (Rung& rung : rungs_) {
        const RungCost& cost = costs.of(rung.start);
        const double sum = costs.ms(rung.start);
        if (std::isfinite(sum) && sum > 0.0) {
            rung.triangle_share = cost.ms_per_triangle * std::fmax(rung.start.work.triangles, 0.0) / sum;
            rung.sample_share =
                cost.ms_per_sample * std::fmax(rung.start.work.pixels, 0.0) * rung.start.samples / sum;
        }
    }
}

double FrameTimeModel::relative_work(const Rung& rung, double triangles, double pixels) const {
    return 1.0 + rung.triangle_share * (triangles - 1.0) + rung.sample_share * (pixels - 1.0);
}

double FrameTimeModel::expected_ms(std::size_t rung) const {
    const Rung& r = rungs_[rung];
    return r.start.ms * relative_work(r, triangles_, pixels_) * std::exp(r.log_own + log_load_);
}

bool FrameTimeModel::observe(std::size_t rung, const FrameWork& work, double ms, MonotonicTime now) {
    if (!is_time(ms)) {
        return false;
    }
    Rung& r = rungs_[rung];
    const bool changed = last_rung_ && *last_rung_ != rung;
    const double dt = last_rung_ ? std::clamp(to_seconds(now - last_time_), 0.0, most_dt_s) : time_constant_s;
    learned_s_ = changed ? 0.0 : (last_rung_ ? learned_s_ + dt : learning_s);
    last_rung_ = rung;
    last_time_ = now;
    const double triangles = relative(work.triangles, r.start.work.triangles);
    const double pixels = relative(work.pixels, r.start.work.pixels);
    const double weight = follow_share(dt, time_constant_s);
    triangles_ += weight * (triangles - triangles_);
    pixels_ += weight * (pixels - pixels_);
    if (!std::isfinite(r.start.ms)) { // never measured before: this is its start time
        r.start.ms = ms / (relative_work(r, triangles, pixels) * std::exp(r.log_own + log_load_));
        return true;
    }
    const double surprise =
        std::log(ms / (r.start.ms * relative_work(r, triangles, pixels))) - r.log_own - log_load_;
    if (learned_s_ < learning_s) {
        r.log_own = bounded(r.log_own + weight * surprise);
    } else {
        const double forgotten = follow_share(dt, forgetting_s) * r.log_own;
        r.log_own -= forgotten;
        log_load_ = bounded(log_load_ + forgotten + weight * surprise);
    }
    return true;
}

double FrameTimeModel::load() const {
    return std::exp(log_load_);
}

void FrameTimeModel::set_load(double load) {
    if (std::isfinite(load) && load > 0.0) {
        log_load_ = bounded(std::log(load));
    }
}

} // namespace frustumscreen
