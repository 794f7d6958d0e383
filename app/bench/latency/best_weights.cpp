#include "app/bench/latency/best_weights.h"

#include "app/tracking/pose_math.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace frustumscreen::bench {

namespace {

constexpr double memory_s = 0.2;
constexpr double max_samples = 40.0;   ///< 80 unknowns
constexpr double usual_ahead_s = 0.04; ///< brings all columns to one scale

/// A picture that is to be predicted.
struct Asked {
    std::size_t latest = 0; ///< the newest sample that has arrived
    double lit_s = 0.0;
    double ahead_s = 0.0;
};

std::vector<Asked> asked_pictures(std::span<const RecordedPose> samples, double length_s,
                                  const TrackedBy& tracker, const LatencySetting& setting,
                                  std::size_t memory) {
    std::vector<Asked> pictures;
    std::size_t arrived = 0;
    for (int frame = 0;; ++frame) {
        const double now_s = frame / setting.display_hz;
        const double lit_s = now_s + 1e-3 * setting.display_latency_ms;
        if (lit_s >= length_s) {
            return pictures;
        }
        while (arrived < samples.size() && samples[arrived].t_s + 1e-3 * tracker.latency_ms <= now_s) {
            ++arrived;
        }
        if (arrived > memory) {
            pictures.push_back({arrived - 1, lit_s, lit_s - samples[arrived - 1].t_s});
        }
    }
}

using Steps = Eigen::MatrixX3d; ///< a row for each weight
Eigen::RowVector3d row_of(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

/// The steps that the weights multiply: shifts or turns.
Steps past_steps(std::span<const RecordedPose> samples, const Asked& asked, std::size_t memory, bool turns) {
    Steps steps(static_cast<Eigen::Index>(2 * memory), 3);
    const geometry::RigidTransform& latest = samples[asked.latest].pose;
    for (std::size_t back = 1; back <= memory; ++back) {
        const tracking::PoseStep step = tracking::step_between(latest, samples[asked.latest - back].pose);
        const auto row = static_cast<Eigen::Index>(back - 1);
        steps.row(row) = row_of(turns ? step.turn_rad : step.shift_m);
        steps.row(row + static_cast<Eigen::Index>(memory)) = steps.row(row) * (asked.ahead_s / usual_ahead_s);
    }
    return steps;
}

Eigen::VectorXd fitted_weights(std::span<const RecordedPose> samples, const HandMotion& truth,
                               std::span<const Asked> pictures, std::size_t memory, bool turns) {
    const auto count = static_cast<Eigen::Index>(2 * memory);
    Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(count, count);
    Eigen::VectorXd products = Eigen::VectorXd::Zero(count);
    for (const Asked& asked : pictures) {
        const Steps steps = past_steps(samples, asked, memory, turns);
        const tracking::PoseStep way = tracking::step_between(samples[asked.latest].pose, truth(asked.lit_s));
        squares += steps * steps.transpose();
        products += steps * row_of(turns ? way.turn_rad : way.shift_m).transpose();
    }
    return squares.ldlt().solve(products);
}

} // namespace

std::vector<LitPicture> pictures_by_best_weights(std::span<const RecordedPose> samples,
                                                 const HandMotion& truth, double length_s,
                                                 const TrackedBy& tracker, const LatencySetting& setting) {
    const auto memory = static_cast<std::size_t>(std::clamp(memory_s * tracker.rate_hz, 2.0, max_samples));
    const std::vector<Asked> pictures = asked_pictures(samples, length_s, tracker, setting, memory);
    const Eigen::VectorXd shift_weights = fitted_weights(samples, truth, pictures, memory, false);
    const Eigen::VectorXd turn_weights = fitted_weights(samples, truth, pictures, memory, true);
    std::vector<LitPicture> lit;
    lit.reserve(pictures.size());
    for (const Asked& asked : pictures) {
        const Eigen::RowVector3d shift =
            shift_weights.transpose() * past_steps(samples, asked, memory, false);
        const Eigen::RowVector3d turn = turn_weights.transpose() * past_steps(samples, asked, memory, true);
        lit.push_back({asked.lit_s,
                       tracking::moved(samples[asked.latest].pose,
                                       {{shift.x(), shift.y(), shift.z()}, {turn.x(), turn.y(), turn.z()}}),
                       truth(asked.lit_s)});
    }
    return lit;
}

} // namespace frustumscreen::bench
