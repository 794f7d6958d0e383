/// Position and motion of a point in three dimensions, from noisy measurements: several models of a hand's
/// motion, each a Kalman filter, weighted by how well they predict the measurements.
///
/// The three axes share one covariance, since noise and motion prefer no axis: a model's state is three
/// vectors (position, velocity, acceleration) and a 3 x 3 matrix. Positions are relative to a reference that
/// the caller keeps, so the arithmetic serves positions and, as rotation vectors, orientations.
///
/// Units    the caller's: metres or radians, and seconds.
/// Time     steps above 0; state transition and process noise are the exact integrals over a step, so a step
///          of any length is stable.
/// Threads  one caller. Allocates nothing.
/// Source   Blom and Bar-Shalom, The interacting multiple model algorithm for systems with Markovian
///          switching coefficients, 1988; models after Bar-Shalom, Li and Kirubarajan, Estimation with
///          Applications to Tracking and Navigation, 2001, 6.2; Creep is the process of Uhlenbeck and
///          Ornstein, On the theory of the Brownian motion, 1930. Differs in that the probability of a change
///          of model is the exact exponential of a rate, not a number per step. A single model is the
///          ordinary Kalman filter.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <span>

namespace frustumscreen::tracking {

/// One model of a hand's motion.
struct MotionModel {
    enum class Kind {
        Rest,      ///< it stands still; its position is a random walk
        Creep,     ///< a slow, steady hand: a decaying velocity, driven by white acceleration
        Glide,     ///< constant velocity, driven by white acceleration
        Manoeuvre, ///< constant acceleration, driven by white jerk
    };
    Kind kind = Kind::Glide;
    double noise = 1.0;   ///< root of the driving noise's density: unit / s^0.5, / s^1.5, / s^2.5
    double fades_s = 1.0; ///< Creep: time constant of its velocity, so fast motion is not taken for creep
};

struct MotionTrackOptions {
    std::span<const MotionModel> models; ///< 1 to `max_models`; copied
    double measured_sd = 1.0;            ///< of each axis
    double first_velocity_sd = 1.0;
    double first_acceleration_sd = 1.0;
    double changes_per_s = 1.0; ///< rate of changes of the model
};

class MotionTrack {
public:
    static constexpr std::size_t max_models = 4;

    explicit MotionTrack(const MotionTrackOptions& options);

    /// Restarts: the reference is a first measurement, and nothing else is known.
    void restart();
    /// Lets time pass: returns the expected movement of the reference; the caller must apply it.
    [[nodiscard]] glm::dvec3 advance(double dt_s);
    /// Takes a measurement relative to the reference; returns the correction of the reference, which the
    /// caller must apply.
    [[nodiscard]] glm::dvec3 correct(const glm::dvec3& measured);

    /// The motion of the weighted mean of the models.
    [[nodiscard]] const glm::dvec3& velocity() const { return velocity_; }
    [[nodiscard]] const glm::dvec3& acceleration() const { return acceleration_; }

    /// Error of the position on each axis, `ahead_s` after the latest measurement, standard deviation.
    [[nodiscard]] double place_sd(double ahead_s) const;
    /// Probability of a manoeuvre, 0 to 1.
    [[nodiscard]] double manoeuvring() const;

private:
    struct ModeState {
        std::array<glm::dvec3, 3> mean{}; ///< position, velocity, acceleration
        glm::dmat3 covariance{0.0};       ///< of each axis
        double weight = 1.0;
    };
    using ModeStates = std::array<ModeState, max_models>;

    void mix(double dt_s);
    /// Subtracts the weighted mean position from every model's, and returns it.
    glm::dvec3 rebase();
    [[nodiscard]] std::span<ModeState> modes() { return {modes_.data(), count_}; }

    std::array<MotionModel, max_models> models_{};
    std::size_t count_;
    MotionTrackOptions options_;
    ModeStates modes_{};
    glm::dvec3 velocity_{0.0};
    glm::dvec3 acceleration_{0.0};
};

} // namespace frustumscreen::tracking
