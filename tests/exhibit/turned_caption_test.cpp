// A caption turns to the visitor's side.

#include "app/typography/captions.h"

#include <gtest/gtest.h>

#include <array>
#include <optional>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::milliseconds;

const std::array picture_m{glm::dvec2(-0.4, -0.25), glm::dvec2(0.4, -0.25), glm::dvec2(0.4, 0.25),
                           glm::dvec2(-0.4, 0.25)};
const std::array sizes{glm::dvec2(0.16, 0.05)};

struct Reader {
    typography::CaptionPlacer placer{picture_m};
    MonotonicTime now{};

    Reader() { placer.set_shapes(sizes); }
    typography::CaptionPlace step(int quarter_turns, milliseconds later = milliseconds(16)) {
        now += later;
        placer.update(now, typography::polygon_of({{0.0, 0.0}, {0.16, 0.16}}), std::nullopt, {0.0, 0.0},
                      quarter_turns);
        return placer.at(now);
    }
};

/// The directions from the table's middle to the reader's edge, and to the reader's right.
struct Side {
    glm::dvec2 near, right;
};
constexpr std::array sides{Side{{0, -1}, {1, 0}}, Side{{1, 0}, {0, 1}}, Side{{0, 1}, {-1, 0}},
                           Side{{-1, 0}, {0, -1}}};

TEST(TurnedCaption, StandsUprightForTheReaderBetweenThemAndTheProp) {
    for (int quarter = 0; quarter < 4; ++quarter) {
        Reader reader;
        reader.step(quarter);
        const typography::CaptionPlace place = reader.step(quarter, milliseconds(400));
        ASSERT_EQ(place.opacity, 1.0) << quarter;
        const Side& side = sides.at(static_cast<std::size_t>(quarter));
        EXPECT_GT(glm::dot(place.rectangle.centre_m, side.near), 0.08) << quarter;
        const std::array<glm::dvec2, 4> corner = place.rectangle.corners();
        EXPECT_LT(glm::distance(corner[1] - corner[0], sizes[0].x * side.right), 1e-12) << quarter;
        EXPECT_LT(glm::distance(corner[3] - corner[0], -sizes[0].y * side.near), 1e-12) << quarter;
        for (const glm::dvec2& each : corner) {
            EXPECT_LE(std::abs(each.x), 0.4);
            EXPECT_LE(std::abs(each.y), 0.25);
        }
    }
}

TEST(TurnedCaption, FadesOutAndInWhenTheReaderChangesSides) {
    Reader reader;
    reader.step(0);
    typography::CaptionPlace before = reader.step(0, milliseconds(400));
    bool dark = false;
    for (int k = 0; k < 60; ++k) {
        const typography::CaptionPlace place = reader.step(2);
        const bool turned = place.rectangle.quarter_turns != before.rectangle.quarter_turns;
        const double jump =
            turned ? place.opacity + before.opacity : std::abs(place.opacity - before.opacity);
        EXPECT_LT(jump, 0.15) << k;
        dark = dark || place.opacity < 0.02;
        before = place;
    }
    EXPECT_TRUE(dark);
    EXPECT_EQ(before.rectangle.quarter_turns, 2);
    EXPECT_EQ(before.opacity, 1.0);
}

TEST(TurnedCaption, StaysForAReaderWhoReturnsAtOnce) {
    Reader reader;
    reader.step(0);
    const glm::dvec2 centre = reader.step(0, milliseconds(400)).rectangle.centre_m;
    reader.step(1);
    for (int k = 0; k < 60; ++k) {
        const typography::CaptionPlace place = reader.step(0);
        EXPECT_EQ(place.rectangle.quarter_turns, 0) << k;
        EXPECT_EQ(place.rectangle.centre_m, centre) << k;
    }
    EXPECT_EQ(reader.step(0).opacity, 1.0);
}

} // namespace
} // namespace frustumscreen::exhibit
