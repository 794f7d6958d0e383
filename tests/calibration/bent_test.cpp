// Metal near the tracker: what a map of its field takes back, and that none is made where nothing is bent.
#include "app/bench/table/bent_field.h"
#include "app/calibration/agreement.h"
#include "app/calibration/bent_touches.h"
#include "app/calibration/starts.h"
#include "tests/calibration/simulated_touches.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <numbers>

namespace frustumscreen {
namespace {

Touches reported(Touches touches, const Metal& metal) {
    for (Touch& touch : touches) {
        touch.tracker_from_sensor = metal.reported(touch.tracker_from_sensor);
    }
    return touches;
}

/// The best fit of these touches without a map, whether they agree or not.
CalibratedTable without_map(const Touches& touches, const TouchSetup& setup) {
    const FitSetup fit{setup.noise, setup.priors, setup.sensor_height_m, {}};
    return *in_table_frame(best_fit(touches, fit, starting_models(touches, setup.width, setup.height)).model);
}

TEST(BentField, TheTrackerWithoutMetalReportsTheTruth) {
    SeededNumbers numbers(1);
    const Metal none{{0.3, 0.1, -0.4}, 0.0};
    for (int k = 0; k < 20; ++k) {
        const RigidTransform pose{numbers.rotation(), 0.5 * numbers.normals()};
        const RigidTransform said = none.reported(pose);
        EXPECT_LT(glm::distance(said.translation, pose.translation), 1e-12);
        EXPECT_GT(std::abs(glm::dot(said.rotation, pose.rotation)), 1.0 - 1e-12);
    }
}

TEST(BentField, AMapIsBoundedOutsideItsBox) {
    FieldMap map;
    map.box_from_tracker = {glm::angleAxis(0.7, glm::dvec3(0.0, 0.0, 1.0)), {0.1, 0.0, 0.0}};
    map.half_m = {0.4, 0.3, 0.1};
    map.shift_m[0] = {1e-3, 0.0, 0.0};
    map.shift_m[4] = {0.0, 2e-3, 0.0}; // x^2
    const RigidTransform out = map.box_from_tracker.inverse();
    const glm::dvec3 edge = out.point({0.4, 0.0, 0.0});
    const glm::dvec3 at_edge = map.place(edge) - edge;
    EXPECT_NEAR(glm::length(at_edge), std::hypot(1e-3, 2e-3), 1e-15);
    for (const double beyond : {1e-9, 1.0, 1e6}) {
        const glm::dvec3 far = out.point({0.4 + beyond, 0.0, 0.0});
        EXPECT_LT(glm::distance(map.place(far) - far, at_edge), 1e-15 + 1e-9 * beyond) << beyond;
    }
}

TEST(BentField, TheSignedRankTestIsThatOfAllSigns) {
    // Ten pairs, each way round: how many of 1024 have a sum of ranks as large.
    const std::vector<double> seen{0.1, 0.9, 0.4, -0.2, 0.7, 1.3, -0.3, 0.8, 0.5, 1.1};
    int as_large = 0;
    for (int signs = 0; signs < 1024; ++signs) {
        int sum = 0;
        for (int k = 0; k < 10; ++k) {
            sum += (signs >> k & 1) != 0 ? k + 1 : 0;
        }
        as_large += sum >= 55 - 2 - 3 ? 1 : 0; // the negative ones have the ranks 2 and 3
    }
    EXPECT_NEAR(signed_rank_chance(seen), as_large / 1024.0, 4e-3); // ten pairs are few for the normal law
}

/// Crosses as docs/calibration.md asks for them where metal is near: a grid over the picture, on blocks that change.
std::vector<Cross> grid(const SimulatedTable& table, int columns, int rows) {
    constexpr std::array blocks{0.0, 0.08, 0.04, 0.12};
    const Pinhole& p = table.truth.pinhole;
    std::vector<Cross> crosses;
    for (int k = 0; k < columns * rows; ++k) {
        const int row = k / columns;
        const int column = k % columns;
        const glm::dvec2 share(static_cast<double>(column) / (columns - 1),
                               static_cast<double>(row) / (rows - 1));
        crosses.push_back({glm::dvec2(p.width, p.height) * (0.04 + 0.92 * share),
                           blocks[static_cast<std::size_t>((2 * row + 3 * column + row * column) % 4)],
                           0.5 * std::numbers::pi * ((7 * k + row) % 4)});
    }
    return crosses;
}

struct Grid {
    int columns, rows;
};
constexpr std::array grids{Grid{5, 3}, Grid{5, 4}, Grid{6, 5}};

struct BendFigures {
    int found = 0, judged = 0,
        broken = 0; ///< maps; good or usable; of these, beyond what the verdict promises
    double before_mm = 0.0, after_mm = 0.0;             ///< mean picture error
    double before_worst_mm = 0.0, after_worst_mm = 0.0; ///< mean of the worst places
};

BendFigures figures_of(double bend_m, const Grid& size, std::uint64_t seeds) {
    BendFigures figures;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const BentTable bent = bent_table(seed, bend_m);
        SeededNumbers numbers(4000 + seed);
        const Touches touches = reported(
            touches_of(bent.table, grid(bent.table, size.columns, size.rows), {}, numbers), bent.metal);
        const TouchSetup setup = setup_for(bent.table);
        const Reported metal = [&](const RigidTransform& pose) { return bent.metal.reported(pose); };
        const PictureError before = picture_error(bent.table, without_map(touches, setup), 0.12, metal);
        const TouchCalibration found = calibrate_touch(touches, setup);
        PictureError after = before; // without a map nothing changes
        if (found.field) {
            after = picture_error(bent.table, *found.table, 0.12, metal);
        }
        figures.found += found.field ? 1 : 0;
        if (found.verdict == Verdict::Good || found.verdict == Verdict::Usable) {
            ++figures.judged;
            figures.broken += after.worst_m > (found.verdict == Verdict::Good ? 5e-3 : 8e-3) ? 1 : 0;
        }
        const double share = 1e3 / static_cast<double>(seeds);
        figures.before_mm += share * before.mean_m;
        figures.after_mm += share * after.mean_m;
        figures.before_worst_mm += share * before.worst_m;
        figures.after_worst_mm += share * after.worst_m;
    }
    std::printf("bent by %4.1f mm, %d touches, %d tables: mean %.2f -> %.2f mm, worst place %.2f -> %.2f mm; "
                "%d maps, %d good or usable, %d of them beyond\n",
                1e3 * bend_m, size.columns * size.rows, static_cast<int>(seeds), figures.before_mm,
                figures.after_mm, figures.before_worst_mm, figures.after_worst_mm, figures.found,
                figures.judged, figures.broken);
    return figures;
}

TEST(BentField, AMapTakesBackWhatMetalBends) {
    const BendFigures figures = figures_of(20e-3, {5, 4}, 10);
    EXPECT_EQ(figures.broken, 0);
    EXPECT_GT(figures.found, 0);
    EXPECT_LT(figures.after_mm, figures.before_mm);
}

TEST(BentField, NoMapIsMadeWhereNothingIsBent) {
    int maps = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const SimulatedTable table = some_table(seed);
        SeededNumbers numbers(1000 + seed);
        const Touches touches = touches_of(table, grid(table, 5, 3), {}, numbers);
        maps += calibrate_touch(touches, setup_for(table)).field ? 1 : 0;
    }
    EXPECT_LE(maps, 2);
}

// The table of docs/calibration.md: `ctest -C long -R calibration_fields`.
TEST(BentField, DISABLED_TheTableOfFigures) {
    for (const Grid& size : grids) {
        for (const double bend_m : {1e-3, 2e-3, 5e-3, 10e-3, 20e-3}) {
            EXPECT_EQ(figures_of(bend_m, size, 40).broken, 0);
        }
        int maps = 0;
        double worse = 0.0;
        constexpr int seeds = 200;
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
            const SimulatedTable table = some_table(seed);
            SeededNumbers numbers(1000 + seed);
            const Touches touches = touches_of(table, grid(table, size.columns, size.rows), {}, numbers);
            const TouchSetup setup = setup_for(table);
            const TouchCalibration found = calibrate_touch(touches, setup);
            if (found.field) {
                ++maps;
                worse = std::fmax(worse, picture_error(table, *found.table, 0.12).mean_m -
                                             picture_error(table, without_map(touches, setup), 0.12).mean_m);
            }
        }
        std::printf(
            "clean, %d touches: %d maps of %d tables; the mean picture error %.2f mm larger at worst\n",
            size.columns * size.rows, maps, seeds, 1e3 * worse);
        EXPECT_LE(maps, seeds / 50);
    }
}

} // namespace
} // namespace frustumscreen
