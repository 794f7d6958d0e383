#include "app/tracking/pose_math.h"
#include "tests/tracking/exact_pose.h"

#include <gtest/gtest.h>

#include <random>

namespace frustumscreen::tracking {
namespace {

exact_pose::Vector some_axis(std::mt19937_64& random) {
    std::normal_distribution<long double> normal;
    exact_pose::Vector axis{normal(random), normal(random), normal(random)};
    const long double length = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    for (long double& part : axis) {
        part /= length;
    }
    return axis;
}

TEST(PoseMath, RotationVectorsRoundTripAtEveryAngle) {
    std::mt19937_64 random(3);
    for (const long double angle : {1e-300L, 1e-12L, 1e-9L, 1e-8L, 1e-7L, 1e-3L, 1.0L, 3.0L, 3.14159265L}) {
        const exact_pose::Vector axis = some_axis(random);
        const glm::dvec3 vector(static_cast<double>(angle * axis[0]), static_cast<double>(angle * axis[1]),
                                static_cast<double>(angle * axis[2]));
        EXPECT_LT(exact_pose::angle(rotation_of(vector), exact_pose::about(axis, angle)), 1e-15);
        const glm::dvec3 back = rotation_vector(rotation_of(vector));
        EXPECT_LE(glm::length(back - vector), 1e-15 + 1e-14 * static_cast<double>(angle));
        const glm::dvec3 other_sign = rotation_vector(-rotation_of(vector));
        EXPECT_LE(glm::length(other_sign - vector), 1e-15 + 1e-14 * static_cast<double>(angle));
    }
    EXPECT_EQ(rotation_vector(rotation_of(glm::dvec3(0.0))), glm::dvec3(0.0));
}

TEST(PoseMath, BetweenIsTheExactSlerpAndAStraightLine) {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<long double> turn(0.001L, 3.1L);
    for (int k = 0; k < 200; ++k) {
        const exact_pose::Quaternion a = exact_pose::about(some_axis(random), turn(random));
        const exact_pose::Quaternion b = exact_pose::about(some_axis(random), turn(random));
        const double share = static_cast<double>(k) / 199.0;
        const double sign = k % 2 == 0 ? 1.0 : -1.0;
        const geometry::RigidTransform from{exact_pose::rounded(a), {1.0, 2.0, -3.0}};
        const geometry::RigidTransform to{sign * exact_pose::rounded(b), {2.0, 0.0, 1.0}};
        const geometry::RigidTransform pose = between(from, to, share);
        EXPECT_LT(exact_pose::angle(pose.rotation, exact_pose::slerp(a, b, share)), 1e-13);
        EXPECT_LT(glm::length(pose.translation - glm::mix(from.translation, to.translation, share)),
                  1e-15 * 8);
    }
}

TEST(PoseMath, SlipBoundsTheMotionOfAPointAtTheLever) {
    const geometry::RigidTransform pose{rotation_of({0.1, 0.2, 0.3}), {0.1, 0.0, 0.0}};
    const PoseStep step{{0.001, 0.0, 0.0}, {0.0, 0.002, 0.0}};
    const geometry::RigidTransform other = moved(pose, step);
    const glm::dvec3 point(0.0, 0.0, 0.06);
    EXPECT_LE(glm::length(other.point(point) - pose.point(point)), slip_m(step, 0.06));
    EXPECT_DOUBLE_EQ(slip_m(step, 0.06), 0.00112);
    EXPECT_NEAR(slip_m(step_between(pose, other), 0.06), 0.00112, 1e-15);
}

} // namespace
} // namespace frustumscreen::tracking
