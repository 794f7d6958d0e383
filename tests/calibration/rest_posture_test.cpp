// The board's posture, its rest and its next place, from the tracker alone.
#include "app/calibration/procedure/rest_request.h"
#include "app/calibration/procedure/still_reports.h"
#include "tests/simulators/table/simulated_rests.h"

#include <gtest/gtest.h>

#include <cmath>

namespace frustumscreen::calibration {
namespace {

TEST(RestRequest, EveryFourthRestLeansAndAHiddenTopNeedsABlock) {
    const glm::dvec2 size(640.0, 400.0);
    for (const bool has_top : {true, false}) {
        std::vector<TakenRest> taken;
        std::vector<glm::dvec2> places;
        for (int k = 0; k < 16; ++k) {
            const RestRequest wish = next_request(taken, size);
            EXPECT_EQ(wish.posture == Posture::Leaning, k % 4 == 3) << k;
            for (std::size_t j = 0; k < 11 && j < places.size(); ++j) {
                EXPECT_GT(glm::distance(wish.pixel, places[j]), 50.0); // each place once
            }
            places.push_back(wish.pixel);
            TakenRest rest;
            rest.posture = wish.posture;
            rest.has_top = has_top;
            rest.rest.points.push_back({{}, wish.pixel});
            taken.push_back(rest);
        }
        EXPECT_EQ(count_of(taken, Posture::Leaning), 4U);
        EXPECT_EQ(count_of(taken, Posture::Block) > 2, !has_top);
    }
}

TEST(StillReports, IgnoreAStrayReport) {
    StillReports still(3);
    const geometry::RigidTransform here;
    const geometry::RigidTransform elsewhere{{1.0, 0.0, 0.0, 0.0}, {0.01, 0.0, 0.0}};
    MonotonicTime now{};
    const auto add = [&](const geometry::RigidTransform& report) {
        return still.add(now += std::chrono::milliseconds(10), report);
    };
    EXPECT_TRUE(add(here));
    EXPECT_TRUE(add(elsewhere));
    EXPECT_TRUE(add(here));
    EXPECT_EQ(still.mean().translation, here.translation);
    EXPECT_EQ(still.rest(), Nanoseconds(std::chrono::milliseconds(20)));
    EXPECT_TRUE(add(elsewhere));
    EXPECT_TRUE(add(elsewhere));
    EXPECT_FALSE(add(elsewhere));
    EXPECT_EQ(still.rest(), Nanoseconds(0));
    EXPECT_EQ(still.mean().translation, elsewhere.translation);
}

/// The report of a prop turned by `yaw_rad`, raised or leaning, from a tilted tracker.
geometry::RigidTransform standing(double yaw_rad, double raised_m, double lean_rad) {
    const simulators::SimulatedTable table = simulators::some_table(3);
    simulators::SeededNumbers numbers(static_cast<std::uint64_t>(1e3 * (yaw_rad + raised_m + lean_rad)));
    return simulators::simulated_report(
        table, simulators::placed_prop({0.1, 0.2 - 0.1 * yaw_rad, raised_m}, yaw_rad, lean_rad, 1.0), {},
        numbers);
}

TEST(RestPosture, IsDerivedFromTrackerReports) {
    const geometry::RigidTransform alike[] = {standing(1.0, 0.0, 0.0), standing(1.1, 0.0, 0.0)};
    EXPECT_FALSE(flat_posture(alike));
    const geometry::RigidTransform rests[] = {standing(0.0, 0.0, 0.0), standing(1.5, 0.0, 0.0),
                                              standing(3.0, 0.0, 0.0)};
    const auto flat = flat_posture(rests);
    ASSERT_TRUE(flat);
    EXPECT_LT(flat->tilt_rad, 0.01);
    const RestStance again = stance_of(*flat, standing(4.5, 0.0, 0.0));
    EXPECT_LT(again.tilt_rad, 0.012);
    EXPECT_NEAR(again.raised_m, 0.0, 1.5e-3);
    const RestStance raised = stance_of(*flat, standing(2.0, 0.12, 0.0));
    EXPECT_LT(raised.tilt_rad, 0.012);
    EXPECT_NEAR(std::abs(raised.raised_m), 0.12, 1.5e-3);
    EXPECT_NEAR(stance_of(*flat, standing(2.0, 0.05, 0.4)).tilt_rad, 0.4, 0.012);
    const geometry::RigidTransform one_leans[] = {rests[0], rests[1], standing(3.0, 0.03, 0.2)};
    EXPECT_GT(flat_posture(one_leans)->tilt_rad, 0.035);
}

} // namespace
} // namespace frustumscreen::calibration
