// Calibration by hand with a ruler: exact without error; with 5 mm of error, compared with touches.
#include "app/calibration/corner_uncertainty.h"
#include "tests/calibration/measured_corners.h"
#include "tests/calibration/simulated_touches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace frustumscreen::calibration {
namespace {

TEST(Corners, FindsTheProjectorWithoutError) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        simulators::SimulatedTable table = simulators::some_table(seed);
        table.truth.pinhole.lens = {};
        simulators::SeededNumbers numbers(seed);
        const geometry::Pinhole& p = table.truth.pinhole;
        const CornerCalibration found =
            calibrate_corners(measured_corners(table, 0.4, 0.0, numbers), p.width, p.height);
        ASSERT_TRUE(found.pinhole) << found.reason.sentence;
        EXPECT_NEAR(found.pinhole->fx, p.fx, 1e-7 * p.fx);
        EXPECT_NEAR(found.pinhole->fy, p.fy, 1e-7 * p.fy);
        EXPECT_NEAR(found.pinhole->cx, p.cx, 1e-6 * p.width);
        EXPECT_NEAR(found.pinhole->cy, p.cy, 1e-6 * p.width);
        EXPECT_LT(glm::distance(found.centre_m, table.truth.table_from_projector.translation), 1e-6);
        EXPECT_LT(found.worst_residual_m, 1e-8);
    }
}

TEST(Corners, RefusesDegenerateAndMirroredCorners) {
    const simulators::SimulatedTable table = simulators::some_table(3);
    simulators::SeededNumbers numbers(3);
    const geometry::Pinhole& p = table.truth.pinhole;
    std::vector<MeasuredCorner> corners = measured_corners(table, 0.4, 0.0, numbers);
    const std::vector<MeasuredCorner> once(corners.begin(), corners.begin() + 4);
    EXPECT_EQ(calibrate_corners(once, p.width, p.height).verdict, Verdict::Refused);
    EXPECT_EQ(calibrate_corners(measured_corners(table, 0.001, 0.0, numbers), p.width, p.height).verdict,
              Verdict::Refused);
    for (MeasuredCorner& corner : corners) {
        corner.corner = static_cast<PictureCorner>((5 - static_cast<int>(corner.corner)) % 4); // mirrored
    }
    EXPECT_EQ(calibrate_corners(corners, p.width, p.height).verdict, Verdict::Refused);
}

// The tracker's registration is the truth here. Even so, the picture by hand is many times worse.
TEST(Corners, ErrorIsAtLeastFiveTimesThatOfTouches) {
    ChosenCrosses crosses;
    double by_hand = 0.0;
    double by_touch = 0.0;
    int refused = 0;
    constexpr int seeds = 40;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const simulators::SimulatedTable table = simulators::some_table(seed);
        simulators::SeededNumbers numbers(4000 + seed);
        const geometry::Pinhole& p = table.truth.pinhole;
        const CornerCalibration hand =
            calibrate_corners(measured_corners(table, 0.4, 0.005, numbers), p.width, p.height);
        const TouchCalibration touch =
            calibrate_touch(touches_of(table, crosses.of(table, 9), {}, numbers), setup_for(table));
        ASSERT_TRUE(touch.table);
        if (!hand.pinhole) {
            ++refused;
            continue;
        }
        CalibratedTable calibrated = table.truth;
        calibrated.pinhole = *hand.pinhole;
        calibrated.pinhole.lens = {};
        calibrated.table_from_projector = hand.measured_from_projector;
        by_hand += simulators::registration_error(table, calibrated, 0.12).mean_m;
        by_touch += simulators::registration_error(table, *touch.table, 0.12).mean_m;
    }
    std::printf("by hand %.2f mm, by touch %.2f mm on average; %d of %d refused\n",
                1e3 * by_hand / (seeds - refused), 1e3 * by_touch / (seeds - refused), refused, seeds);
    EXPECT_GE(by_hand, 5.0 * by_touch);
    EXPECT_LE(refused, seeds / 10);
}

/// The reported uncertainty is the ruler's effect on the picture, for a lens without distortion; a lens that
/// distorts is worse.
TEST(Corners, UncertaintyMatchesTheRulersEffect) {
    double said = 0.0;
    double made = 0.0;
    double distorted = 0.0;
    double ruler_m = 0.0;
    double places = 0.0;
    double tables = 0.0;
    int refused = 0;
    constexpr int seeds = 100;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        for (const bool distorts : {false, true}) {
            simulators::SimulatedTable table = simulators::some_table(seed);
            table.truth.pinhole.lens = distorts ? table.truth.pinhole.lens : geometry::Lens{};
            simulators::SeededNumbers numbers(4000 + seed);
            const geometry::Pinhole& p = table.truth.pinhole;
            const std::vector<MeasuredCorner> corners = measured_corners(table, 0.4, 0.005, numbers);
            const CornerCalibration found = calibrate_corners(corners, p.width, p.height);
            if (!found.pinhole) { // a corner looks wrong by chance
                ++refused;
                continue;
            }
            const CornerUncertainty uncertainty = uncertainty_of(found, corners, 0.12);
            ASSERT_EQ(uncertainty.zone.size(), 3 * zone_columns * zone_rows);
            ruler_m += distorts ? 0.0 : uncertainty.ruler_error_m;
            tables += distorts ? 0.0 : 1.0;
            CalibratedTable calibrated = table.truth;
            calibrated.pinhole = *found.pinhole;
            calibrated.table_from_projector = found.measured_from_projector;
            for (const PlaceUncertainty& place : uncertainty.zone) {
                const glm::dvec3 meant = simulators::true_light(calibrated, place.pixel, place.height_m);
                const glm::dvec3 lit = simulators::true_light(table.truth, place.pixel, place.height_m);
                const double square = std::pow(glm::distance(meant, lit), 2.0);
                (distorts ? distorted : made) += square;
                said += distorts ? 0.0 : place.rms_m * place.rms_m;
                places += distorts ? 0.0 : 1.0;
            }
        }
    }
    std::printf("by hand the picture is off by %.2f mm root mean square, said are %.2f mm; with distortion "
                "%.2f mm; the ruler "
                "errs by %.2f mm\n",
                1e3 * std::sqrt(made / places), 1e3 * std::sqrt(said / places),
                1e3 * std::sqrt(distorted / places), 1e3 * ruler_m / tables);
    EXPECT_NEAR(std::sqrt(made / said), 1.0, 0.2);
    EXPECT_NEAR(ruler_m / tables, 0.005, 0.0005);
    // One right corner in a hundred looks wrong. At most 8 of 200 sets are expected; more than 17 have a
    // probability of 0.001.
    EXPECT_LE(refused, 17);
}

TEST(Corners, AssumesTheMinimumRulerErrorForExactCorners) {
    simulators::SimulatedTable table = simulators::some_table(2);
    table.truth.pinhole.lens = {};
    simulators::SeededNumbers numbers(2);
    const geometry::Pinhole& p = table.truth.pinhole;
    const std::vector<MeasuredCorner> corners = measured_corners(table, 0.4, 0.0, numbers);
    const CornerUncertainty exact =
        uncertainty_of(calibrate_corners(corners, p.width, p.height), corners, 0.12);
    EXPECT_EQ(exact.ruler_error_m, min_ruler_error_m);
    EXPECT_GT(exact.picture.mean_m, 0.2e-3);
    EXPECT_LT(exact.picture.worst_m, 3e-3);
}

} // namespace
} // namespace frustumscreen::calibration
