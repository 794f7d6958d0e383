#include "app/geometry/transform.h"
#include "app/scene/light.h"
#include "app/settings/light_range.h"
#include "app/settings/lit_zone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace frustumscreen::scene {
namespace {

const geometry::Pinhole pinhole{1280, 800, 1900.0, 1850.0, 600.0, 450.0};

struct Lit {
    geometry::PropShape prop = geometry::make_frustum({});
    geometry::RigidTransform projector_from_prop{{0.0, 1.0, 0.0, 0.0}, {0.03, -0.02, 0.9}}; // looking down
    glm::dvec3 projector() const { return projector_from_prop.inverse().translation; }
};

TEST(Light, GainTimesReceivedLightIsTheReferenceEverywhereOnAFace) {
    const Lit lit;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    for (const geometry::PropFace& face : lit.prop.faces) {
        const double reference = 0.2;
        const FaceLight light = face_light(face, lit.projector_from_prop.matrix(), reference);
        for (int k = 0; k < 200; ++k) {
            const double s = u(random);
            const double t = u(random);
            const glm::dvec3 p = glm::mix(glm::mix(face.corners[0], face.corners[1], s),
                                          glm::mix(face.corners[3], face.corners[2], s), t);
            const glm::dvec3 to_light = lit.projector() - p;
            const double d = glm::length(to_light);
            const double received = glm::dot(face.plane.normal, to_light / d) / (d * d);
            ASSERT_NEAR(settings::received_light(face.plane, p, lit.projector()), received, 1e-12);
            const auto pixel = pinhole.pixel(lit.projector_from_prop.point(p));
            ASSERT_TRUE(pixel);
            ASSERT_NEAR(gain(light, pinhole, *pixel) * received,
                        static_cast<double>(light.most) * std::min(received, reference), 1e-5);
        }
    }
}

double dimmest_corner(const geometry::PropFace& face, const glm::dvec3& lens) {
    double dimmest = 1e9;
    for (const glm::dvec3& corner : face.corners) {
        const glm::dvec3 to_light = lens - corner;
        const double d = glm::length(to_light);
        dimmest = std::min(dimmest, glm::dot(face.plane.normal, to_light) / (d * d * d));
    }
    return dimmest;
}

std::vector<SeenFace> all_faces(const geometry::PropShape& prop, const glm::dvec3& eye) {
    std::vector<SeenFace> faces;
    for (const geometry::PropFace& face : prop.faces) {
        faces.push_back({&face, eye});
    }
    return faces;
}

TEST(Light, TheReferenceStandsWhereEveryFaceReachesIt) {
    const Lit lit;
    double least = 1e9;
    for (const geometry::PropFace& face : lit.prop.faces) {
        least = std::min(least, dimmest_corner(face, lit.projector()));
    }
    for (const glm::dvec3 eye :
         {glm::dvec3(0.0, -0.5, 0.5), glm::dvec3(0.3, 0.1, 0.2), glm::dvec3(0, 0, 2)}) {
        EXPECT_EQ(reference_light(all_faces(lit.prop, eye), lit.projector(), {least}), least);
    }
}

TEST(Light, TheWholeArtifactDimsWithAFaceThatTheEyeSeesInFull) {
    const Lit lit;
    const geometry::PropFace& front = lit.prop.faces[3];
    const double reached = dimmest_corner(front, lit.projector());
    const glm::dvec3 square_before = front.middle() + 0.6 * front.plane.normal;
    const auto reference = [&](double aim, double min_share) {
        return reference_light(all_faces(lit.prop, square_before), lit.projector(), {aim, min_share});
    };
    EXPECT_NEAR(reference(1.25 * reached, 0.1), reached, 1e-9) << "down to what the face can send back";
    EXPECT_NEAR(reference(10.0 * reached, 0.3), 3.0 * reached, 1e-9) << "but not below the share";
    EXPECT_EQ(reference(10.0 * reached, 1.0), 10.0 * reached) << "or not at all";
}

TEST(Light, AFaceThatTheEyeDoesNotSeeCountsForNothing) {
    const Lit lit;
    const double aim = 1.2 * dimmest_corner(lit.prop.faces[3], lit.projector());
    const glm::dvec3 from_above(0.0, 0.0, 3.0); // the sides are seen at a sine of 0.28 - 0.03
    const glm::dvec3 from_behind(0.0, 0.6, 0.4);
    const std::vector<SeenFace> front_and_top{{&lit.prop.faces[3], from_behind},
                                              {&lit.prop.faces[4], from_behind}};
    EXPECT_EQ(reference_light(front_and_top, lit.projector(), {aim, 0.1}), aim);
    const double above = reference_light(
        std::vector<SeenFace>{{&lit.prop.faces[3], from_above}, {&lit.prop.faces[4], from_above}},
        lit.projector(), {aim, 0.1});
    EXPECT_LT(above, aim);
    EXPECT_GT(above, aim / 1.2) << "it counts in part";
}

TEST(Light, AFaceFadesOutWhereTheLightGrazesIt) {
    const Lit lit;
    const geometry::PropFace& front = lit.prop.faces[3];
    const glm::dvec3 middle = front.middle();
    const glm::dvec3 along = glm::normalize(front.corners[3] - front.corners[0]);
    double before = -1.0;
    for (int k = 0; k <= 300; ++k) {
        const double sine = 1e-3 * k + 1e-4;
        const glm::dvec3 lens = middle + std::sqrt(1.0 - sine * sine) * along + sine * front.plane.normal;
        glm::dmat4 projector_from_prop(1.0); // the direction is irrelevant, only the lens's position counts
        projector_from_prop[3] = glm::dvec4(-lens, 1.0);
        const FaceLight light = face_light(front, projector_from_prop, 0.2);
        EXPECT_GE(light.most, before) << sine;
        EXPECT_LT(light.most - before, k > 0 ? 0.01 : 2.0) << sine;
        EXPECT_EQ(light.most == 0.0F, sine <= settings::min_sine_of_light) << sine;
        EXPECT_EQ(light.most == 1.0F, sine >= full_sine_of_light) << sine;
        before = light.most;
    }
}

} // namespace
} // namespace frustumscreen::scene
