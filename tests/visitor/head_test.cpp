#include "app/tracking/seen_head.h"
#include "app/visitor/head_fit.h"
#include "tests/simulators/visitor/simulated_people.h"

#include <gtest/gtest.h>

#include <cmath>

namespace frustumscreen::visitor {
namespace {

/// Looks from the far edge to the front, slightly up.
const geometry::RigidTransform table_from_camera{
    glm::quat_cast(glm::dmat3(glm::dvec3(-1, 0, 0), glm::normalize(glm::dvec3(0, -0.3, -0.95)),
                              glm::normalize(glm::dvec3(0, -0.95, 0.3)))),
    {0.0, 0.28, 0.12}};
const geometry::Pinhole camera{320, 180, 147.0, 147.0, 160.0, 90.0, {-0.15, 0.01}};

/// Pixels whose ray meets any of the ellipsoids.
std::vector<std::uint8_t> outline_of(const std::vector<simulators::Ball>& balls) {
    std::vector<std::uint8_t> mask;
    for (int row = 0; row < camera.height; ++row) {
        for (int column = 0; column < camera.width; ++column) {
            const glm::dvec3 ray = table_from_camera.direction(camera.ray({column + 0.5, row + 0.5}));
            bool met = false;
            for (const simulators::Ball& one : balls) {
                met = met || simulators::enter(one, table_from_camera.translation, ray).has_value();
            }
            mask.push_back(met ? 255 : 0);
        }
    }
    return mask;
}

std::vector<FittedHead> heads_in(const std::vector<std::uint8_t>& mask) {
    std::vector<FittedHead> heads;
    for (const HeadOutline& outline : find_head_outlines(mask, camera.width, camera.height)) {
        if (const auto head = fit_head(outline, camera, table_from_camera, {})) {
            heads.push_back(*head);
        }
    }
    return heads;
}

double degrees_off(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::acos(glm::dot(glm::normalize(a - table_from_camera.translation),
                                           glm::normalize(b - table_from_camera.translation))));
}

/// The model's own shape, at different distortions of the lens.
TEST(Head, FindsAnUprightEllipsoid) {
    for (const glm::dvec3 place :
         {glm::dvec3(0.0, -0.4, 0.5), glm::dvec3(0.45, -0.5, 0.3), glm::dvec3(-0.5, -0.35, 0.7)}) {
        const auto heads =
            heads_in(outline_of({simulators::ball(place, glm::dmat3(1.0), {0.089, 0.089, 0.116}, 0.5)}));
        ASSERT_EQ(heads.size(), 1U);
        EXPECT_LT(degrees_off(heads[0].middle_m, place), 0.5); // a pixel is 0.4
        EXPECT_LT(glm::distance(heads[0].middle_m, place), 2.0 * heads[0].along_sd_m);
        EXPECT_LT(heads[0].along_sd_m, 0.12);
    }
}

/// Heads that differ from the model: people of all builds, with hair, turned and bent, on shoulders, with
/// arms.
TEST(Head, FindsTheEyeOfAPerson) {
    std::mt19937_64 random(7);
    const glm::dvec3 prop(0.05, 0.0, 0.08);
    double squares = 0.0;
    int people = 0;
    for (int k = 0; k < 24; ++k) {
        const simulators::Build build = k % 3 == 0   ? simulators::Build::Child
                                        : k % 3 == 1 ? simulators::Build::Adult
                                                     : simulators::Build::Seated;
        simulators::Person person = simulators::any_person(build, random);
        person.hair = person.hair == simulators::Hair::Hat ? simulators::Hair::Short : person.hair;
        const glm::dvec3 eye = simulators::any_eye(build, 0.04 * (k - 12), 0.12, {0.8, 0.5}, random);
        const auto heads = heads_in(outline_of(simulators::body_of(person, eye, prop)));
        ASSERT_EQ(heads.size(), 1U) << k;
        const glm::dvec3 found = tracking::eye_of_head(heads[0].middle_m, prop);
        const glm::dvec3 line = glm::normalize(eye - prop);
        const double across = glm::length(glm::cross(found - eye, line));
        EXPECT_LT(across, 0.06) << k;
        squares += across * across;
        ++people;
    }
    EXPECT_LT(std::sqrt(squares / people), 0.03);
}

TEST(Head, SeparatesTwoPeopleWhoStandClose) {
    std::mt19937_64 random(3);
    std::vector<simulators::Ball> both;
    for (const double x : {-0.14, 0.14}) {
        simulators::Person person = simulators::any_person(simulators::Build::Adult, random);
        person.hair = simulators::Hair::Short;
        const auto body = simulators::body_of(person, {x, -0.42, 0.6}, {0.0, 0.0, 0.08});
        both.insert(both.end(), body.begin(), body.end());
    }
    EXPECT_EQ(heads_in(outline_of(both)).size(), 2U);
}

TEST(Head, IgnoresDistantPeopleAndArms) {
    std::mt19937_64 random(5);
    const simulators::Person person = simulators::any_person(simulators::Build::Adult, random);
    EXPECT_TRUE(
        heads_in(outline_of(simulators::body_of(person, {0.3, -2.4, 0.7}, {0.0, 0.0, 0.08}))).empty());
    const std::vector<simulators::Ball> arm{
        simulators::limb({-0.3, -0.4, 0.3}, {0.3, -0.4, 0.32}, 0.04, 0.5)};
    EXPECT_TRUE(heads_in(outline_of(arm)).empty());
}

TEST(Head, LowersTheEyeWhenLookingDown) {
    const glm::dvec3 middle(0.0, -0.5, 0.5);
    const glm::dvec3 level = tracking::eye_of_head(middle, {0.0, 0.0, 0.5});
    EXPECT_GT(level.y, middle.y + 0.07);
    EXPECT_LT(tracking::eye_of_head(middle, {0.0, 0.0, 0.0}).z, level.z - 0.02);
    EXPECT_TRUE(std::isfinite(tracking::eye_of_head(middle, middle).x));
}

} // namespace
} // namespace frustumscreen::visitor
