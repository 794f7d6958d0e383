// Whether a line meets an object's box, against points along the line.

#include "app/room/line_of_sight.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace frustumscreen::room {
namespace {

double between(std::mt19937_64& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

bool holds(const Object& object, const glm::dvec3& box_size, double seconds, double grown,
           const glm::dvec3& point) {
    const glm::dvec3 at = table_from_object(object, seconds).inverse().point(point);
    const glm::dvec3 size = object.size_m * box_size;
    return std::abs(at.x) <= 0.5 * grown * size.x && std::abs(at.y) <= 0.5 * grown * size.y &&
           std::abs(at.z - 0.5 * size.z) <= 0.5 * grown * size.z;
}

TEST(LineOfSight, MeetsABoxAtTheFirstPointInsideIt) {
    std::mt19937_64 random(3);
    int met = 0;
    for (int k = 0; k < 1500; ++k) {
        Object object;
        object.place_m = {between(random, -0.5, 0.5), between(random, 0.5, 2.0), between(random, -0.3, 0.3)};
        object.turn_deg = between(random, -180.0, 180.0);
        object.size_m = between(random, 0.1, 0.8);
        object.motion = {
            .turns_per_minute = between(random, -9.0, 9.0), .sway_m = {0.2, 0.1, 0.0}, .sway_s = 3.0};
        const glm::dvec3 box_size(1.0, between(random, 0.1, 1.0), between(random, 0.1, 1.0));
        const double seconds = between(random, 0.0, 1e4);
        const double grown = k % 2 == 0 ? 1.0 : held_size;
        const Line line{{0.0, -0.6, 0.5}, {between(random, -0.2, 0.2), 0.0, between(random, 0.2, 0.5)}};
        const std::optional<double> at = meets(line, object, box_size, seconds, grown);
        const auto point = [&](double along) { return line.from_m + along * (line.through_m - line.from_m); };
        std::optional<double> first;
        for (double along = 1.0; along < 6.0 && !first; along += 0.002) {
            first =
                holds(object, box_size, seconds, grown, point(along)) ? std::optional(along) : std::nullopt;
        }
        if (first) { // a corner may be thinner than the points are apart
            ASSERT_TRUE(at) << k;
        }
        if (at) {
            EXPECT_TRUE(holds(object, box_size, seconds, grown + 1e-9, point(*at))) << k;
            EXPECT_FALSE(*at > 1.001 && holds(object, box_size, seconds, grown, point(*at - 1e-6))) << k;
            ++met;
        }
    }
    EXPECT_GT(met, 200);
}

TEST(LineOfSight, MeetsTheNearestObjectAndHoldsTheLastOne) {
    std::array<Object, 2> objects;
    objects[0].place_m = {0.0, 2.0, 0.0};
    objects[1].place_m = {0.0, 1.0, 0.0};
    objects[0].size_m = objects[1].size_m = 0.2;
    const std::array<SeenObject, 2> seen{{{0, glm::dvec3(1.0)}, {1, glm::dvec3(1.0)}}};
    const Line straight{{0.0, -0.5, 0.1}, {0.0, 0.0, 0.1}};
    EXPECT_EQ(first_met(straight, objects, seen, 0.0, {}), 1U);
    const Line beside{{0.12, -0.5, 0.1}, {0.12, 0.0, 0.1}}; // 2 cm from both
    EXPECT_EQ(first_met(beside, objects, seen, 0.0, {}), std::nullopt);
    EXPECT_EQ(first_met(beside, objects, seen, 0.0, 0), 0U);
    const Line behind{{0.0, 3.0, 0.1}, {0.0, 3.5, 0.1}}; // the objects are behind the eye
    EXPECT_EQ(first_met(behind, objects, seen, 0.0, {}), std::nullopt);
    EXPECT_EQ(first_met({{0.0, -0.5, 0.1}, {0.0, -0.5, 0.1}}, objects, seen, 0.0, {}), std::nullopt);
}

TEST(LineOfSight, GoesThroughTheScreenOrPassesIt) {
    const std::array<glm::dvec3, 4> screen{
        {{-0.6, 0.7, 0.8}, {0.6, 0.7, 0.8}, {0.6, 0.7, 0.2}, {-0.6, 0.7, 0.2}}};
    const glm::dvec3 eye(0.0, -0.55, 0.5);
    const auto through = [&](double x, double z) {
        return Line{eye, glm::mix(eye, glm::dvec3(x, 0.7, z), 0.4)};
    };
    EXPECT_TRUE(goes_through(through(0.59, 0.79), screen));
    EXPECT_TRUE(goes_through(through(-0.59, 0.21), screen));
    EXPECT_FALSE(goes_through(through(0.61, 0.5), screen));
    EXPECT_FALSE(goes_through(through(0.0, 0.19), screen));
    EXPECT_FALSE(goes_through({eye, {0.0, -1.0, 0.5}}, screen));  // away from it
    EXPECT_FALSE(goes_through({eye, {0.3, -0.55, 0.5}}, screen)); // along it
}

} // namespace
} // namespace frustumscreen::room
