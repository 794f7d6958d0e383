// The laid-out table in use: beside a caption, and while the prop moves over it.
#include "app/exhibit/table_layout.h"
#include "app/typography/captions.h"
#include "tests/exhibit/some_tables.h"

#include <gtest/gtest.h>

namespace frustumscreen::exhibit {
namespace {

/// A caption finds space in the area that is left for it.
TEST(TableInUse, CaptionFitsBesideThePicturesWithThePropAtHome) {
    std::mt19937_64 random(17);
    int tried = 0;
    for (int k = 0; k < 400; ++k) {
        const TableSetUp set_up = some_set_up(random);
        const int side = static_cast<int>(random() % 4);
        const TableLayout layout = lay_out_table(set_up, side);
        if (!layout.caption) {
            continue;
        }
        ++tried;
        typography::CaptionPlacer placer(set_up.picture_m);
        placer.set_shapes(set_up.captions_m);
        std::vector<typography::TableRectangle> obstacles;
        for (const TablePlace& place : layout.places) {
            obstacles.push_back(place.whole());
        }
        placer.set_obstacles(obstacles);
        const geometry::RigidTransform home = standing(set_up.home_m, between(random, -3.2, 3.2));
        const std::optional<typography::TablePolygon> shadow =
            typography::hidden_by_prop(set_up.prop, home, set_up.lens_m);
        for (const int ms : {0, 500}) {
            placer.update(MonotonicTime{} + std::chrono::milliseconds(ms), shadow, std::nullopt,
                          set_up.home_m, side);
        }
        const typography::CaptionPlace caption = placer.at(MonotonicTime{} + std::chrono::milliseconds(500));
        EXPECT_EQ(caption.opacity, 1.0) << k;
        for (const typography::TableRectangle& obstacle : obstacles) {
            EXPECT_GE(typography::clearance(caption.rectangle.corners(), obstacle.corners()), 0.008 - 1e-9)
                << k;
        }
    }
    EXPECT_GT(tried, 80);
}

/// The picture under the prop dims without a jump as the prop approaches, and the others stay.
TEST(TableInUse, PictureDimsSmoothlyAsThePropApproaches) {
    TableSetUp set_up;
    set_up.artifacts = 12;
    set_up.picture_m = {{-0.4, -0.25}, {0.4, -0.25}, {0.4, 0.25}, {-0.4, 0.25}};
    set_up.prop = geometry::make_frustum(geometry::shipped_frustum);
    set_up.lens_m = {0.0, 0.0, 1.5};
    const TableLayout layout = lay_out_table(set_up, 0);
    ASSERT_EQ(layout.places.size(), 12U);
    std::mt19937_64 random(16);
    for (int stroke = 0; stroke < 40; ++stroke) {
        const TablePlace& goal = layout.places[random() % layout.places.size()];
        const double yaw = between(random, -3.2, 3.2);
        std::vector<double> before(layout.places.size(), 1.0);
        const int steps = 600;
        for (int step = 0; step <= steps; ++step) {
            const glm::dvec2 at = goal.picture.centre_m * (static_cast<double>(step) / steps);
            const std::optional<typography::TablePolygon> shadow =
                typography::hidden_by_prop(set_up.prop, standing(at, yaw), set_up.lens_m);
            ASSERT_TRUE(shadow);
            // The shadow moves with the prop; that of its top 1.5 / (1.5 - 0.155) times as far.
            const double moved = 1.12 * glm::length(goal.picture.centre_m) / steps;
            for (std::size_t k = 0; k < layout.places.size(); ++k) {
                const double now = place_brightness(layout.places[k], shadow);
                EXPECT_LE(std::abs(now - before[k]), 1.5 * moved / 0.012 + 1e-9);
                const double clear =
                    typography::clearance(layout.places[k].whole().corners(), shadow->corners());
                EXPECT_EQ(now >= 1.0, clear >= 0.012);
                EXPECT_EQ(now <= 0.0, clear <= 0.0);
                before[k] = now;
            }
        }
        EXPECT_EQ(place_brightness(goal, typography::hidden_by_prop(set_up.prop,
                                                                    standing(goal.picture.centre_m, yaw),
                                                                    set_up.lens_m)),
                  0.0);
    }
    EXPECT_EQ(place_brightness(layout.places.front(), std::nullopt), 0.0);
}

} // namespace
} // namespace frustumscreen::exhibit
