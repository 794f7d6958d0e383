// The drawing of the room: what it draws is read from the SVG, as any other program would.
#include "app/drawing/drawing.h"
#include "tests/drawing/svg_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace frustumscreen::drawing {
namespace {

settings::Settings with_screen() {
    settings::Settings settings;
    settings.screen.room = "room.toml";
    settings.screen.corners_m = {{{-0.6, 0.4, 0.675}, {0.6, 0.4, 0.675}, {0.6, 0.4, 0.0}, {-0.6, 0.4, 0.0}}};
    return settings;
}

DrawnObject box(std::string name, const glm::dvec3& place_m, double half_m, double high_m,
                double turn = 0.0) {
    DrawnObject object{.name = std::move(name),
                       .foot_m = {},
                       .low_m = place_m.z,
                       .high_m = place_m.z + high_m,
                       .place_m = place_m,
                       .size_m = std::max(2.0 * half_m, high_m)};
    for (const glm::dvec2 side :
         {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)}) {
        const glm::dvec2 turned(side.x * std::cos(turn) - side.y * std::sin(turn),
                                side.x * std::sin(turn) + side.y * std::cos(turn));
        object.foot_m.push_back(glm::dvec2(place_m) + half_m * turned);
    }
    return object;
}

std::vector<DrawnObject> hall() {
    std::vector<DrawnObject> objects{box("floor", {0.0, 2.4, -0.27}, 1.9, 0.02)};
    for (int k = 0; k < 10; ++k) {
        const glm::dvec3 place(k % 2 == 0 ? -0.7 : 0.7, 0.3 + 0.4 * k, -0.25);
        objects.push_back(box(fmt::format("plinth {}", k), place, 0.15, 0.34, 0.1 * k));
        objects.push_back(box(fmt::format("vase {}", k), place + glm::dvec3(0.0, 0.0, 0.34), 0.09, 0.3));
    }
    return objects;
}

TEST(RoomSheet, DrawsEveryObjectInBothViewsAtItsPlace) {
    const std::vector<DrawnObject> objects = hall();
    const std::vector<SvgPolygon> drawn = named_polygons(room_sheet(with_screen(), objects, "hall.toml"));
    constexpr double written_m = 1e-4;
    for (const DrawnObject& object : objects) {
        std::size_t views = 0;
        for (const SvgPolygon& each : drawn) {
            if (each.name != object.name) {
                continue;
            }
            ++views;
            ASSERT_EQ(each.corners.size(), 4U);
            for (std::size_t k = 0; k < 4; ++k) {
                if (each.view == "plan") { // y to the right, x down
                    EXPECT_NEAR(each.corners[k].x, object.foot_m[k].y, written_m);
                    EXPECT_NEAR(each.corners[k].y, -object.foot_m[k].x, written_m);
                } else {
                    EXPECT_TRUE(std::abs(each.corners[k].y - object.low_m) < written_m ||
                                std::abs(each.corners[k].y - object.high_m) < written_m);
                }
            }
        }
        EXPECT_EQ(views, 2U) << object.name;
    }
    for (const char* name : {"table", "prop", "screen"}) {
        EXPECT_EQ(
            std::count_if(drawn.begin(), drawn.end(), [&](const auto& each) { return each.name == name; }), 2)
            << name;
    }
}

TEST(RoomSheet, NamesEachObjectWithoutOverlap) {
    const std::vector<DrawnObject> objects = hall();
    const std::vector<SvgText> all = texts(room_sheet(with_screen(), objects, "hall.toml"));
    for (const DrawnObject& object : objects) {
        EXPECT_EQ(std::count_if(all.begin(), all.end(),
                                [&](const auto& each) { return each.words == object.name; }),
                  1)
            << object.name;
    }
    for (std::size_t a = 0; a < all.size(); ++a) {
        EXPECT_TRUE(all[a].low.x > 10.0 && all[a].low.y > 10.0 && all[a].high.x < 410.0 &&
                    all[a].high.y < 287.0)
            << all[a].words;
        for (std::size_t b = a + 1; b < all.size(); ++b) {
            EXPECT_FALSE(all[a].meets(all[b])) << all[a].words << " / " << all[b].words;
        }
    }
}

TEST(RoomSheet, FitsThePaperForAnyRoomSize) {
    for (const double metres : {0.4, 3.0, 30.0, 90.0}) {
        std::vector<DrawnObject> objects{box("far", {0.3 * metres, metres, 0.0}, 0.1 * metres, 0.2 * metres)};
        for (int k = 0; k < 80; ++k) {
            objects.push_back(
                box(fmt::format("thing {}", k), {0.0, 0.01 * metres * k, 0.0}, 0.01 * metres, 0.01));
        }
        const std::string svg = room_sheet(with_screen(), objects, "large.toml");
        std::size_t polygons = 0;
        for (const SvgText& text : texts(svg)) {
            EXPECT_TRUE(text.low.x > 10.0 && text.high.x < 410.0 && text.high.y < 287.0) << text.words;
        }
        for (const SvgPolygon& each : named_polygons(svg)) {
            polygons += each.name == "far" || each.name.starts_with("thing") ? 1 : 0;
        }
        EXPECT_EQ(polygons, 2 * objects.size()) << "those without a line in the list are drawn too";
        EXPECT_NE(svg.find("and 29 more, without numbers"), std::string::npos);
    }
}

} // namespace
} // namespace frustumscreen::drawing
