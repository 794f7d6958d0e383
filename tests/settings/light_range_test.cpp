#include "app/settings/light_range.h"
#include "tests/settings/lit_at_each_yaw.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace frustumscreen::settings {
namespace {

/// The prop's faces in the table's frame, computed by plain rotation.
struct StandingFace {
    glm::dvec3 normal;
    std::vector<glm::dvec3> corners;
    glm::dvec3 middle{0.0};
};
std::vector<StandingFace> standing(const geometry::PropShape& prop, const glm::dvec2& place, double yaw) {
    const auto turned = [yaw](const glm::dvec3& v) {
        return glm::dvec3(std::cos(yaw) * v.x - std::sin(yaw) * v.y,
                          std::sin(yaw) * v.x + std::cos(yaw) * v.y, v.z);
    };
    std::vector<StandingFace> faces;
    for (const geometry::PropFace& face : prop.faces) {
        StandingFace one{turned(face.plane.normal), {}, {}};
        for (const glm::dvec3& corner : face.corners) {
            one.corners.push_back(turned(corner) + glm::dvec3(place, 0.0));
            one.middle += 0.25 * one.corners.back();
        }
        faces.push_back(one);
    }
    return faces;
}

/// cos(theta) / d^2.
double light_at(const glm::dvec3& normal, const glm::dvec3& point, const glm::dvec3& lens) {
    const glm::dvec3 to_lens = lens - point;
    const double d2 = glm::dot(to_lens, to_lens);
    return glm::dot(normal, to_lens / std::sqrt(d2)) / d2;
}

TEST(LightRange, CoversEveryPoseOnTheTable) {
    const geometry::PropShape prop = geometry::make_frustum({0.2, 0.08, 0.1});
    const glm::dvec3 lens(0.05, -0.1, 1.1);
    const glm::dvec2 reach(0.2, 0.1);
    const LightRange range = light_range(prop, lens, reach);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    double least = 1e9;
    double most = 0.0;
    double evenness = 1e9;
    for (int k = 0; k < 20000; ++k) {
        glm::dvec2 place = reach * glm::dvec2(share(random), share(random));
        if (k % 2 == 0) { // the extremes lie at the corners of the zone
            place = reach * glm::dvec2(place.x < 0.0 ? -1.0 : 1.0, place.y < 0.0 ? -1.0 : 1.0);
        }
        double darkest = 1e9;
        double brightest = 0.0;
        for (const StandingFace& face : standing(prop, place, std::numbers::pi * share(random))) {
            const double middle = light_at(face.normal, face.middle, lens);
            darkest = std::min(darkest, middle);
            brightest = std::max(brightest, middle);
            for (const glm::dvec3& corner : face.corners) {
                least = std::min(least, light_at(face.normal, corner, lens));
                most = std::max(most, light_at(face.normal, corner, lens));
            }
        }
        evenness = std::min(evenness, darkest / brightest);
    }
    EXPECT_LT(range.least, least * (1.0 + 1e-3));
    EXPECT_GT(range.least, 0.97 * least);
    EXPECT_NEAR(range.evenness, evenness, 0.01 * evenness);
    EXPECT_GT(range.most, 0.99 * most);
    EXPECT_LT(range.most, 1.05 * most);
}

TEST(LightRange, EvennessIsNegativeIfAFaceLooksAway) {
    const LightRange range = light_range(geometry::make_frustum({}), {0.0, 0.0, 0.5}, {0.4, 0.0});
    EXPECT_LT(range.evenness, 0.0);
    EXPECT_LT(range.least, 0.0);
}

TEST(LightRange, ReachKeepsTheBottomOnTheTable) {
    const TableSettings table{0.8, 0.5};
    const glm::dvec2 reach = reach_on_table({PropKind::Frustum, 0.2, 0.1, 0.1, PropZone::Table}, table);
    const double half_diagonal = std::hypot(0.1, 0.1);
    EXPECT_NEAR(reach.x, 0.4 - half_diagonal, 1e-12);
    EXPECT_NEAR(reach.y, 0.25 - half_diagonal, 1e-12);
    EXPECT_EQ(reach_on_table({PropKind::Frustum, 0.5, 0.1, 0.1, PropZone::Table}, table).y, 0.0);
}

TEST(LightRange, TheShippedTableIsLitEvenlyAllOver) {
    const Settings settings;
    const glm::dvec2 reach = reach_on_table(settings.prop, settings.table);
    const LightRange range =
        light_range(make_prop(settings.prop), settings.projector.table_from_projector.translation, reach);
    EXPECT_GE(range.evenness, 0.35);
    EXPECT_EQ(even_light(settings), std::max(range.least, 0.25 * range.most));
    EXPECT_EQ(even_light(settings), range.least) << "every place can send back as much as every other";
    for (const glm::dvec2 corner :
         {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)}) {
        EXPECT_TRUE(lit_at_each_yaw(settings, 0.999 * corner * reach, settings.eye.default_m));
    }
}

TEST(LightRange, EvenLightIsPositiveDespiteADarkFace) {
    Settings settings;
    settings.prop = {PropKind::Frustum, 0.16, 0.16, 0.12, PropZone::Table}; // upright walls
    const double reference = even_light(settings);
    const double d = settings.projector.table_from_projector.translation.z - settings.prop.height_m;
    EXPECT_GT(reference, 0.2 / (d * d));
    settings.prop.zone = PropZone::Hand;
    EXPECT_NEAR(even_light(settings), 0.25 / (d * d), 1e-12);
}

} // namespace
} // namespace frustumscreen::settings
