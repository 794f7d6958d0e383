#include "app/bench/torch/torch_sweep.h"

#include "app/bench/truth/seeded_draw.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace frustumscreen::bench {

namespace {

/// Between -1 and 1.
class Sway {
public:
    explicit Sway(SeededDraw& draw) : hz_(draw.between(0.15, 0.45)), phase_(draw.between(0.0, 1.0)) {}
    [[nodiscard]] double at(double seconds) const {
        return std::sin(2.0 * std::numbers::pi * (hz_ * seconds + phase_));
    }

private:
    double hz_, phase_;
};

/// From a point in the box to its surface.
double exit_distance(const geometry::Box& box, const glm::dvec3& point, const glm::dvec3& direction) {
    double distance = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double side = direction[axis] > 0.0 ? box.high[axis] : box.low[axis];
        distance =
            direction[axis] != 0.0 ? std::min(distance, (side - point[axis]) / direction[axis]) : distance;
    }
    return distance;
}

struct Hand {
    Sway across, deep, high, around, up, away, twist;
    double first_around;

    explicit Hand(SeededDraw& draw)
        : across(draw), deep(draw), high(draw), around(draw), up(draw), away(draw), twist(draw),
          first_around(draw.between(-std::numbers::pi, std::numbers::pi)) {}

    /// Prop frame.
    [[nodiscard]] geometry::RigidTransform at(double seconds, const geometry::Box& box) const {
        const glm::dvec3 half = 0.5 * (box.high - box.low);
        const glm::dvec3 middle = 0.5 * (box.high + box.low);
        const glm::dvec3 aim =
            middle + 0.7 * half * glm::dvec3(across.at(seconds), deep.at(seconds), high.at(seconds));
        const double azimuth = first_around + 2.0 * around.at(seconds);
        const double elevation = 0.85 + 0.45 * up.at(seconds);
        const glm::dvec3 towards_torch(std::cos(elevation) * std::cos(azimuth),
                                       std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
        const double away_m = exit_distance(box, aim, towards_torch) + 0.08 + 0.05 * away.at(seconds);
        const glm::dvec3 down(0.0, 0.0, -1.0);
        const glm::dvec3 x = glm::normalize(glm::cross(down, -towards_torch));
        const glm::dmat3 axes(x, glm::cross(-towards_torch, x), -towards_torch);
        return {glm::quat_cast(axes) * glm::angleAxis(0.6 * twist.at(seconds), glm::dvec3(0.0, 0.0, 1.0)),
                aim + away_m * towards_torch};
    }
};

} // namespace

torch::Beam sweep_beam() {
    return {.opening_rad = 40.0 * std::numbers::pi / 180.0,
            .height_per_width = 1.0,
            .shape = torch::Shape::Round,
            .attenuation = torch::Attenuation::InverseSquare,
            .full_m = 0.04};
}

Result<std::vector<TorchFrame>> draw_sweep(const settings::Settings& settings,
                                           const geometry::PropShape& prop, const geometry::Box& box,
                                           int frames, std::uint64_t seed) {
    const auto of_walk = static_cast<int>(walk_hz / sweep_hz);
    TRY(const std::vector<BenchPose> walk, draw_walk(settings, prop, of_walk * frames, seed));
    SeededDraw draw(seed + 1000);
    const Hand hand(draw);
    std::vector<TorchFrame> sweep;
    for (int frame = 0; frame < frames; ++frame) {
        const BenchPose& pose = walk[static_cast<std::size_t>(of_walk * frame)];
        sweep.push_back({pose, pose.table_from_prop * hand.at(frame / sweep_hz, box)});
    }
    return sweep;
}

} // namespace frustumscreen::bench
