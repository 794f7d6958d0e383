#include "app/tracking/motion_track.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace frustumscreen::tracking {

namespace {

/// Keeps each weight above zero: a model with weight zero could not recover.
constexpr double min_weight = 1e-9;

/// For steps below this fraction of a velocity's time constant the decay is negligible, and its integral
/// would lose digits.
constexpr double min_fading = 1e-4;

/// glm's order: transition[column][row].
glm::dmat3 transition(const MotionModel& model, double dt) {
    switch (model.kind) {
    case MotionModel::Kind::Rest:
        return {{1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    case MotionModel::Kind::Creep: {
        const double faded = -std::expm1(-dt / model.fades_s);
        return {{1.0, 0.0, 0.0}, {model.fades_s * faded, 1.0 - faded, 0.0}, {0.0, 0.0, 0.0}};
    }
    case MotionModel::Kind::Glide:
        return {{1.0, 0.0, 0.0}, {dt, 1.0, 0.0}, {0.0, 0.0, 0.0}};
    case MotionModel::Kind::Manoeuvre:
        break;
    }
    return {{1.0, 0.0, 0.0}, {dt, 1.0, 0.0}, {0.5 * dt * dt, dt, 1.0}};
}

/// A model without velocity or acceleration knows no more of it than at the start: the variances `velocity`
/// and `acceleration`.
glm::dmat3 driving_noise(const MotionModel& model, double dt, double velocity, double acceleration) {
    const double q = model.noise * model.noise;
    const double dt2 = dt * dt;
    const double dt3 = dt2 * dt;
    const double steps = dt / model.fades_s; // for Creep
    switch (model.kind) {
    case MotionModel::Kind::Creep:
        if (steps > min_fading) {
            const double t = model.fades_s;
            const double faded = -std::expm1(-steps);
            const double both = q * t * t * faded * faded / 2.0;
            return {{q * t * t * t * (steps - faded - faded * faded / 2.0), both, 0.0},
                    {both, q * t * faded * (2.0 - faded) / 2.0, 0.0},
                    {0.0, 0.0, acceleration}};
        }
        [[fallthrough]]; // as Glide
    case MotionModel::Kind::Glide:
        return {{q * dt3 / 3.0, q * dt2 / 2.0, 0.0}, {q * dt2 / 2.0, q * dt, 0.0}, {0.0, 0.0, acceleration}};
    case MotionModel::Kind::Rest:
        return {{q * dt, 0.0, 0.0}, {0.0, velocity, 0.0}, {0.0, 0.0, acceleration}};
    case MotionModel::Kind::Manoeuvre:
        break;
    }
    return {{q * dt3 * dt2 / 20.0, q * dt2 * dt2 / 8.0, q * dt3 / 6.0},
            {q * dt2 * dt2 / 8.0, q * dt3 / 3.0, q * dt2 / 2.0},
            {q * dt3 / 6.0, q * dt2 / 2.0, q * dt}};
}

double spread(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::dot(a, b) / 3.0; // the axes share one covariance
}

} // namespace

MotionTrack::MotionTrack(const MotionTrackOptions& options)
    : count_(options.models.size()), options_(options) {
    assert(count_ >= 1 && count_ <= max_models);
    std::copy(options.models.begin(), options.models.end(), models_.begin());
    options_.models = {};
    restart();
}

void MotionTrack::restart() {
    const double place = options_.measured_sd * options_.measured_sd;
    const double velocity = options_.first_velocity_sd * options_.first_velocity_sd;
    const double acceleration = options_.first_acceleration_sd * options_.first_acceleration_sd;
    for (ModeState& mode : modes()) {
        mode = {};
        mode.covariance = {{place, 0.0, 0.0}, {0.0, velocity, 0.0}, {0.0, 0.0, acceleration}};
        mode.weight = 1.0 / static_cast<double>(count_);
    }
    velocity_ = acceleration_ = glm::dvec3(0.0);
}

void MotionTrack::mix(double dt_s) {
    // The exponential of a generator that leaves every model at an equal rate: exact for any step.
    const double n = static_cast<double>(count_);
    const double other = -std::expm1(-options_.changes_per_s * dt_s) / n;
    const double same = 1.0 - (n - 1.0) * other;
    const ModeStates before = modes_;
    for (std::size_t to = 0; to < count_; ++to) {
        double total = 0.0;
        std::array<double, max_models> share{};
        for (std::size_t from = 0; from < count_; ++from) {
            share[from] = (from == to ? same : other) * before[from].weight;
            total += share[from];
        }
        ModeState mixed;
        mixed.weight = total;
        for (std::size_t from = 0; from < count_; ++from) {
            share[from] /= total;
            for (std::size_t k = 0; k < 3; ++k) {
                mixed.mean[k] += share[from] * before[from].mean[k];
            }
        }
        for (std::size_t from = 0; from < count_; ++from) {
            std::array<glm::dvec3, 3> off{};
            for (std::size_t k = 0; k < 3; ++k) {
                off[k] = before[from].mean[k] - mixed.mean[k];
            }
            mixed.covariance += share[from] * before[from].covariance;
            for (int column = 0; column < 3; ++column) {
                for (int row = 0; row < 3; ++row) {
                    mixed.covariance[column][row] +=
                        share[from] *
                        spread(off[static_cast<std::size_t>(column)], off[static_cast<std::size_t>(row)]);
                }
            }
        }
        modes_[to] = mixed;
    }
}

glm::dvec3 MotionTrack::advance(double dt_s) {
    mix(dt_s);
    const double velocity = options_.first_velocity_sd * options_.first_velocity_sd;
    const double acceleration = options_.first_acceleration_sd * options_.first_acceleration_sd;
    for (std::size_t m = 0; m < count_; ++m) {
        ModeState& mode = modes_[m];
        const glm::dmat3 step = transition(models_[m], dt_s);
        const std::array<glm::dvec3, 3> mean = mode.mean;
        for (int row = 0; row < 3; ++row) {
            mode.mean[static_cast<std::size_t>(row)] =
                step[0][row] * mean[0] + step[1][row] * mean[1] + step[2][row] * mean[2];
        }
        mode.covariance = step * mode.covariance * glm::transpose(step) +
                          driving_noise(models_[m], dt_s, velocity, acceleration);
    }
    return rebase();
}

glm::dvec3 MotionTrack::correct(const glm::dvec3& measured) {
    const double noise = options_.measured_sd * options_.measured_sd;
    std::array<double, max_models> log_likelihood{};
    for (std::size_t m = 0; m < count_; ++m) {
        ModeState& mode = modes_[m];
        const glm::dvec3 surprise = measured - mode.mean[0];
        const glm::dvec3 column = mode.covariance[0];
        const double variance = column[0] + noise;
        const glm::dvec3 gain = column / variance;
        for (std::size_t k = 0; k < 3; ++k) {
            mode.mean[k] += gain[static_cast<int>(k)] * surprise;
        }
        // Joseph's form: symmetric and positive in spite of rounding.
        glm::dmat3 keep(1.0);
        keep[0] -= gain;
        mode.covariance =
            keep * mode.covariance * glm::transpose(keep) + noise * glm::outerProduct(gain, gain);
        log_likelihood[m] = -0.5 * glm::dot(surprise, surprise) / variance - 1.5 * std::log(variance);
    }
    const double best = *std::max_element(log_likelihood.begin(), log_likelihood.begin() + count_);
    double total = 0.0;
    for (std::size_t m = 0; m < count_; ++m) {
        modes_[m].weight = std::fmax(modes_[m].weight * std::exp(log_likelihood[m] - best), min_weight);
        total += modes_[m].weight;
    }
    for (ModeState& mode : modes()) {
        mode.weight /= total;
    }
    return rebase();
}

double MotionTrack::manoeuvring() const {
    double sum = 0.0;
    for (std::size_t m = 0; m < count_; ++m) {
        sum += models_[m].kind == MotionModel::Kind::Manoeuvre ? modes_[m].weight : 0.0;
    }
    return sum;
}

double MotionTrack::place_sd(double ahead_s) const {
    MotionTrack later = *this;
    if (ahead_s > 0.0) {
        static_cast<void>(later.advance(ahead_s));
    }
    double variance = 0.0;
    for (const ModeState& mode : later.modes()) { // positions relative to the weighted mean
        variance += mode.weight * (mode.covariance[0][0] + spread(mode.mean[0], mode.mean[0]));
    }
    return std::sqrt(variance);
}

glm::dvec3 MotionTrack::rebase() {
    glm::dvec3 place(0.0);
    velocity_ = acceleration_ = glm::dvec3(0.0);
    for (const ModeState& mode : modes()) {
        place += mode.weight * mode.mean[0];
        velocity_ += mode.weight * mode.mean[1];
        acceleration_ += mode.weight * mode.mean[2];
    }
    for (ModeState& mode : modes()) {
        mode.mean[0] -= place;
    }
    return place;
}

} // namespace frustumscreen::tracking
