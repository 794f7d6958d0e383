#include "app/scene/frame_time_model.h"

#include "app/geometry/time_curves.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::scene {

namespace {

/// Limit of |log|: larger than any real change of a GPU's speed. It keeps a run of bad values from ending in
/// infinity.
constexpr double max_log = 7.0;

double bounded(double logarithm) {
    return std::clamp(logarithm, -max_log, max_log);
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

FrameTimeModel::FrameTimeModel(const std::vector<QualityLevelTime>& quality_levels) {
    for (const QualityLevelTime& start : quality_levels) {
        quality_levels_.push_back({start});
        if (!is_time(start.ms)) {
            quality_levels_.back().start.ms = std::numeric_limits<double>::infinity();
        }
    }
    fit_shares();
}

double QualityLevelCost::ms(const FrameWork& work, int samples) const {
    return fixed_ms + ms_per_triangle * std::fmax(work.triangles, 0.0) +
           ms_per_sample * std::fmax(work.pixels, 0.0) * samples;
}

namespace {

/// Fit over the levels that are drawn in this way. A small ridge term helps where they cannot separate the
/// terms.
QualityLevelCost cost_of(const std::vector<QualityLevelTime>& quality_levels, bool relief, bool on_gpu) {
    const auto is_alike = [=](const QualityLevelTime& quality_level) {
        return quality_level.relief == relief && quality_level.on_gpu == on_gpu;
    };
    glm::dvec3 most(1.0, 0.0, 0.0);
    const auto terms = [](const QualityLevelTime& start) {
        return glm::dvec3(1.0, std::fmax(start.work.triangles, 0.0),
                          std::fmax(start.work.pixels, 0.0) * start.samples);
    };
    for (const QualityLevelTime& quality_level : quality_levels) {
        most = is_alike(quality_level) ? glm::max(most, terms(quality_level)) : most;
    }
    const glm::dvec3 scale(1.0, most.y > 0.0 ? 1.0 / most.y : 0.0, most.z > 0.0 ? 1.0 / most.z : 0.0);
    glm::dmat3 normal(0.0);
    glm::dvec3 right(0.0);
    for (const QualityLevelTime& quality_level : quality_levels) {
        if (is_alike(quality_level) && FrameTimeModel::is_time(quality_level.ms)) {
            const glm::dvec3 row = terms(quality_level) * scale / quality_level.ms;
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

FrameCost cost_of(const std::vector<QualityLevelTime>& quality_levels) {
    return {cost_of(quality_levels, false, false), cost_of(quality_levels, true, false),
            cost_of(quality_levels, true, true)};
}

double FrameCost::ms(const QualityLevelTime& quality_level) const {
    return of(quality_level).ms(quality_level.work, quality_level.samples);
}

void FrameTimeModel::fit_shares() {
    std::vector<QualityLevelTime> starts;
    for (const QualityLevel& quality_level : quality_levels_) {
        starts.push_back(quality_level.start);
    }
    const FrameCost costs = cost_of(starts);
    for (QualityLevel& quality_level : quality_levels_) {
        const QualityLevelCost& cost = costs.of(quality_level.start);
        const double sum = costs.ms(quality_level.start);
        if (std::isfinite(sum) && sum > 0.0) {
            quality_level.triangle_share =
                cost.ms_per_triangle * std::fmax(quality_level.start.work.triangles, 0.0) / sum;
            quality_level.sample_share = cost.ms_per_sample *
                                         std::fmax(quality_level.start.work.pixels, 0.0) *
                                         quality_level.start.samples / sum;
        }
    }
}

double FrameTimeModel::relative_work(const QualityLevel& quality_level, double triangles,
                                     double pixels) const {
    return 1.0 + quality_level.triangle_share * (triangles - 1.0) +
           quality_level.sample_share * (pixels - 1.0);
}

double FrameTimeModel::expected_ms(std::size_t quality_level) const {
    const QualityLevel& r = quality_levels_[quality_level];
    return r.start.ms * relative_work(r, triangles_, pixels_) * std::exp(r.log_own + log_load_);
}

bool FrameTimeModel::observe(std::size_t quality_level, const FrameWork& work, double ms, MonotonicTime now) {
    if (!is_time(ms)) {
        return false;
    }
    QualityLevel& r = quality_levels_[quality_level];
    const bool changed = last_quality_level_ && *last_quality_level_ != quality_level;
    const double dt =
        last_quality_level_ ? std::clamp(to_seconds(now - last_time_), 0.0, max_dt_s) : time_constant_s;
    learned_s_ = changed ? 0.0 : (last_quality_level_ ? learned_s_ + dt : learning_s);
    last_quality_level_ = quality_level;
    last_time_ = now;
    const double triangles = relative(work.triangles, r.start.work.triangles);
    const double pixels = relative(work.pixels, r.start.work.pixels);
    const double weight = geometry::follow_share(dt, time_constant_s);
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
        const double forgotten = geometry::follow_share(dt, forgetting_s) * r.log_own;
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

} // namespace frustumscreen::scene
