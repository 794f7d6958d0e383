// Where an object stands at a time, against whole numbers: an angle is a fraction of a turn whose numerator and denominator
// are integers.
#include "app/room/room.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace frustumscreen::room {
namespace {

/// A speed is a whole number of them; exact in binary.
constexpr std::int64_t speed_parts = 1024;
constexpr std::int64_t thirty_years_s = 1'000'000'000;

TEST(PlaceInTheRoom, EqualsThePlaceInTheFileAtTheStart) {
    const Object object{
        .name = "cup", .place_m = {1.0, 2.0, 0.5}, .turn_deg = 90.0, .size_m = 0.4, .motion = {}};
    const geometry::RigidTransform at = table_from_object(object, 0.0);
    EXPECT_EQ(at.translation, object.place_m);
    EXPECT_LT(glm::distance(at.point({1.0, 0.0, 0.0}), glm::dvec3(1.0, 3.0, 0.5)), 1e-15);
    EXPECT_LT(glm::distance(at.point({0.0, 0.0, 1.0}), glm::dvec3(1.0, 2.0, 1.5)), 1e-15);
    EXPECT_EQ(table_from_object(object, 5e8).translation, object.place_m); // it does not move
}

TEST(PlaceInTheRoom, TurnsCounterClockwiseSeenFromAbove) {
    Object object;
    object.place_m = {};
    object.motion.turns_per_minute = 15.0; // a quarter turn in a second
    EXPECT_LT(glm::distance(table_from_object(object, 1.0).point({1.0, 0.0, 0.0}), glm::dvec3(0.0, 1.0, 0.0)),
              1e-15);
    object.motion.turns_per_minute = -15.0;
    EXPECT_LT(
        glm::distance(table_from_object(object, 1.0).point({1.0, 0.0, 0.0}), glm::dvec3(0.0, -1.0, 0.0)),
        1e-15);
}

/// The angle after any time is as exact as at the start.
TEST(PlaceInTheRoom, IsAsExactAfterThirtyYearsAsAtTheStart) {
    Object object;
    object.place_m = {};
    double worst_rad = 0.0;
    for (const std::int64_t parts : {1LL, 77LL, 1025LL, 20'481LL, 61'440LL, -61'439LL}) {
        object.motion.turns_per_minute = static_cast<double>(parts) / speed_parts;
        for (const std::int64_t seconds : {std::int64_t{1}, std::int64_t{86'399}, std::int64_t{31'556'926},
                                           thirty_years_s - 1, thirty_years_s}) {
            const std::int64_t whole = 60 * speed_parts; // parts of a turn
            const std::int64_t turned = parts * seconds % whole;
            const double angle =
                2.0 * std::numbers::pi * static_cast<double>(turned) / static_cast<double>(whole);
            const glm::dvec3 expected(std::cos(angle), std::sin(angle), 0.0);
            const glm::dvec3 found =
                table_from_object(object, static_cast<double>(seconds)).point({1.0, 0.0, 0.0});
            worst_rad = std::fmax(worst_rad, glm::distance(expected, found));
        }
    }
    EXPECT_LT(worst_rad, 4e-15);
}

TEST(PlaceInTheRoom, SwaysToBothSidesAndReturnsExactly) {
    Object object;
    object.place_m = {1.0, 2.0, 3.0};
    object.motion.sway_m = {0.25, -0.5, 0.125};
    object.motion.sway_s = 8.0;
    for (const double start : {0.0, 8.0 * 125'000'000.0}) {
        const auto at = [&](double seconds) {
            return table_from_object(object, start + seconds).translation;
        };
        EXPECT_EQ(at(0.0), object.place_m);
        EXPECT_LT(glm::distance(at(2.0), object.place_m + object.motion.sway_m), 1e-15);
        EXPECT_LT(glm::distance(at(4.0), object.place_m), 1e-15);
        EXPECT_LT(glm::distance(at(6.0), object.place_m - object.motion.sway_m), 1e-15);
    }
}

/// The shortest sway that a file may have, of none, at any time: its place, and no NaN.
TEST(PlaceInTheRoom, StaysConstantWithZeroSway) {
    Object object;
    object.motion.sway_m = {};
    object.motion.sway_s = 0.5;
    for (const double seconds : {0.0, 1e-9, 0.125, 1e6 + 0.1, 1e9 + 0.1}) {
        EXPECT_EQ(table_from_object(object, seconds).translation, object.place_m);
    }
    EXPECT_FALSE(object.motion.moves());
    object.motion.turns_per_minute = -0.001;
    EXPECT_TRUE(object.motion.moves());
}

} // namespace
} // namespace frustumscreen::room
