#include "app/bench/latency/hand_motion.h"

#include "app/tracking/pose_math.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

namespace frustumscreen::bench {

namespace {

constexpr double turning_m_s2 = 5.0;
constexpr double turn_rad_m = 2.0;
constexpr double bend_rad = 0.5; ///< deviation from the reversed direction
constexpr double shortest_m = 0.10;
constexpr double longest_m = 0.25;

/// Moves at constant velocity from `begin_s` on; from `turn_s` on it turns into the next stroke's velocity.
struct Stroke {
    double begin_s = 0.0;
    double turn_s = 0.0;
    glm::dvec3 place_m{0.0};
    double yaw_rad = 0.0;
    glm::dvec3 velocity_m_s{0.0};
    double yaw_rad_s = 0.0;
};

/// Integral of the smooth step x^2 (3 - 2 x).
double eased_way(double x) {
    return x * x * x * (1.0 - 0.5 * x);
}

Stroke at(const Stroke& stroke, const Stroke& next, double t_s) {
    const double straight = std::fmin(t_s, stroke.turn_s) - stroke.begin_s;
    const double turning = std::fmax(0.0, t_s - stroke.turn_s);
    const double length = next.begin_s - stroke.turn_s;
    const double eased = length * eased_way(turning / length);
    Stroke result = stroke;
    result.place_m +=
        stroke.velocity_m_s * (straight + turning) + (next.velocity_m_s - stroke.velocity_m_s) * eased;
    result.yaw_rad += stroke.yaw_rad_s * (straight + turning) + (next.yaw_rad_s - stroke.yaw_rad_s) * eased;
    return result;
}

} // namespace

HandMotion strokes(double speed_m_s, double length_s, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> stroke_m(shortest_m, longest_m);
    std::uniform_real_distribution<double> bend(-bend_rad, bend_rad);
    const auto path = std::make_shared<std::vector<Stroke>>();
    double direction = 2.0 * bend(random);
    Stroke stroke;
    stroke.yaw_rad_s = turn_rad_m * speed_m_s;
    for (;;) {
        stroke.velocity_m_s = speed_m_s * glm::dvec3(std::cos(direction), std::sin(direction), 0.0);
        stroke.turn_s = stroke.begin_s + stroke_m(random) / speed_m_s;
        path->push_back(stroke);
        if (stroke.begin_s > length_s) {
            break;
        }
        direction += 3.14159265358979323846 + bend(random);
        Stroke next;
        next.velocity_m_s = speed_m_s * glm::dvec3(std::cos(direction), std::sin(direction), 0.0);
        next.yaw_rad_s = -stroke.yaw_rad_s;
        // The smooth step's greatest slope is 1.5 times its mean slope.
        next.begin_s =
            stroke.turn_s + 1.5 * glm::length(next.velocity_m_s - stroke.velocity_m_s) / turning_m_s2;
        const Stroke end = at(stroke, next, next.begin_s);
        next.place_m = end.place_m;
        next.yaw_rad = end.yaw_rad;
        stroke = next;
    }
    return [path](double t_s) {
        const auto after = std::upper_bound(path->begin() + 1, path->end() - 1, t_s,
                                            [](double t, const Stroke& s) { return t < s.begin_s; });
        const Stroke now = at(*(after - 1), *after, t_s);
        return geometry::RigidTransform{tracking::rotation_of({0.0, 0.0, now.yaw_rad}), now.place_m};
    };
}

HandMotion stop(double speed_m_s, double braking_m_s2, double brake_at_s) {
    return [=](double t_s) {
        const double braking = std::clamp(t_s - brake_at_s, 0.0, speed_m_s / braking_m_s2);
        const double x =
            speed_m_s * (std::fmin(t_s, brake_at_s) + braking) - 0.5 * braking_m_s2 * braking * braking;
        return geometry::RigidTransform{glm::dquat(1.0, 0.0, 0.0, 0.0), {x, 0.0, 0.0}};
    };
}

HandMotion rest() {
    return [](double /*t_s*/) { return geometry::RigidTransform{}; };
}

HandMotion recorded(std::span<const RecordedPose> poses) {
    return [poses](double t_s) {
        const auto after = std::upper_bound(poses.begin(), poses.end(), t_s,
                                            [](double t, const RecordedPose& p) { return t < p.t_s; });
        if (after == poses.begin()) {
            return poses.front().pose;
        }
        if (after == poses.end()) {
            return poses.back().pose;
        }
        const RecordedPose& before = *(after - 1);
        return tracking::between(before.pose, after->pose, (t_s - before.t_s) / (after->t_s - before.t_s));
    };
}

HandMotion slid(HandMotion hand, double begin_s) {
    const geometry::RigidTransform begin = hand(begin_s);
    return [hand = std::move(hand), begin_s, begin](double t_s) {
        const geometry::RigidTransform now = hand(begin_s + t_s);
        const glm::dquat turn = now.rotation * glm::conjugate(begin.rotation);
        const glm::dquat about_z = glm::normalize(glm::dquat(turn.w, 0.0, 0.0, turn.z));
        const glm::dvec3 way = now.translation - begin.translation;
        return geometry::RigidTransform{about_z, {way.x, way.y, 0.0}};
    };
}

} // namespace frustumscreen::bench
