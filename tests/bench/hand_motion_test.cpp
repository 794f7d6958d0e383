#include "app/bench/latency/hand_motion.h"
#include "app/bench/latency/recorded_poses.h"
#include "app/tracking/pose_math.h"
#include "firmware_host/base/quantile.h"
#include "tests/folders.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

namespace frustumscreen::bench {
namespace {

/// A hand that moves along a screw: around a point, upwards, and rotating with it.
geometry::RigidTransform screw(double t_s) {
    return {tracking::rotation_of({0.0, 0.0, 0.5 * t_s}),
            {0.2 * std::cos(t_s), 0.2 * std::sin(t_s), 0.1 * t_s}};
}

TEST(HandMotion, SlidObjectFollowsTheHandAcrossTheTableAndItsYaw) {
    const HandMotion motion = slid(screw, 1.0);
    const geometry::RigidTransform moved = motion(0.3);
    EXPECT_NEAR(moved.translation.x, 0.2 * (std::cos(1.3) - std::cos(1.0)), 1e-12);
    EXPECT_NEAR(moved.translation.y, 0.2 * (std::sin(1.3) - std::sin(1.0)), 1e-12);
    EXPECT_NEAR(2.0 * std::atan2(moved.rotation.z, moved.rotation.w), 0.15, 1e-12);
    EXPECT_EQ(motion(0.0).translation, glm::dvec3(0.0));
}

TEST(HandMotion, SlidObjectIsNeitherLiftedNorTilted) {
    const HandMotion tilts = [](double t_s) {
        return geometry::RigidTransform{tracking::rotation_of({0.4 * t_s, 0.3, 0.0}), {0.0, 0.0, t_s}};
    };
    const geometry::RigidTransform moved = slid(tilts, 0.5)(0.4);
    EXPECT_EQ(moved.translation, glm::dvec3(0.0));
    EXPECT_LT(glm::distance(moved.rotation * glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(0.0, 0.0, 1.0)), 1e-12);
}

TEST(HandMotion, RecordingIsInterpolatedLinearlyBetweenPoses) {
    const glm::dquat turned = tracking::rotation_of({0.0, 0.0, 0.6});
    const std::array<RecordedPose, 2> poses{{{1.0, {}}, {1.5, {turned, glm::dvec3(0.1, 0.0, 0.0)}}}};
    const geometry::RigidTransform half_way = recorded(poses)(1.25);
    EXPECT_NEAR(half_way.translation.x, 0.05, 1e-12);
    EXPECT_NEAR(2.0 * std::atan2(half_way.rotation.z, half_way.rotation.w), 0.3, 1e-12);
    EXPECT_EQ(recorded(poses)(9.0).translation.x, 0.1);
}

/// The speeds of the recordings (docs/tags.md).
TEST(HandMotion, RecordedHandsAreSlidAtTheirSpeed) {
    const std::filesystem::path folder = shared_dir() + "/data/tracker";
    if (!std::filesystem::exists(folder)) {
        GTEST_SKIP() << folder << " is not there";
    }
    for (const auto& [name, median_m_s] :
         {std::pair("vicon_handheld_1.csv", 0.145), {"tum_fr1_xyz_groundtruth.txt", 0.252}}) {
        const auto poses = read_recorded_poses(folder / name);
        ASSERT_TRUE(poses) << poses.error().message;
        std::vector<double> speeds_m_s;
        for (std::size_t k = 1; k < poses->size(); ++k) {
            const RecordedPose& before = (*poses)[k - 1];
            const double apart_s = (*poses)[k].t_s - before.t_s;
            const geometry::RigidTransform moved = slid(recorded(*poses), before.t_s)(apart_s);
            EXPECT_EQ(moved.translation.z, 0.0);
            speeds_m_s.push_back(glm::length(moved.translation) / apart_s);
        }
        EXPECT_NEAR(quantile(speeds_m_s, 0.5), median_m_s, 0.005);
    }
}

} // namespace
} // namespace frustumscreen::bench
