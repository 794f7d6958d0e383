#include "app/geometry/transform.h"
#include "app/scene/light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace frustumscreen {
namespace {

const Pinhole pinhole{1280, 800, 1900.0, 1850.0, 600.0, 450.0};

struct Lit {
    PropShape prop = make_frustum({});
    RigidTransform projector_from_prop{{0.0, 1.0, 0.0, 0.0}, {0.03, -0.02, 0.9}}; // looking down
    glm::dvec3 projector() const { return projector_from_prop.inverse().translation; }
};

TEST(Light, GainTimesReceivedLightIsTheReferenceEverywhereOnAFace) {
    const Lit lit;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    for (const PropFace& face : lit.prop.faces) {
        const double reference = 0.2;
        const FaceLight light =
            face_light(face.plane, pinhole, lit.projector_from_prop.matrix(), reference, LightCompensation{});
        for (int k = 0; k < 200; ++k) {
            const double s = u(random);
            const double t = u(random);
            const glm::dvec3 p = glm::mix(glm::mix(face.corners[0], face.corners[1], s),
                                          glm::mix(face.corners[3], face.corners[2], s), t);
            const glm::dvec3 to_light = lit.projector() - p;
            const double d = glm::length(to_light);
            const double received = glm::dot(face.plane.normal, to_light / d) / (d * d);
            ASSERT_NEAR(received_light(face.plane, p, lit.projector()), received, 1e-12);
            const auto pixel = pinhole.pixel(lit.projector_from_prop.point(p));
            ASSERT_TRUE(pixel);
            ASSERT_NEAR(gain(light, pinhole, *pixel) * received, std::min(received, reference), 1e-5);
        }
    }
}

TEST(Light, TheReferenceIsTheDimmestCornerSeen) {
    const Lit lit;
    const glm::dvec3 eye(0.0, -0.5, 0.5);
    const std::vector<SeenFace> seen{{&lit.prop.faces[3], eye}, {&lit.prop.faces[4], eye}};
    double dimmest = 1e9;
    for (const SeenFace& s : seen) {
        for (const glm::dvec3& corner : s.face->corners) {
            const glm::dvec3 to_light = lit.projector() - corner;
            const double d = glm::length(to_light);
            dimmest = std::min(dimmest, glm::dot(s.face->plane.normal, to_light) / (d * d * d));
        }
    }
    const double reference = reference_light(seen, lit.projector(), {});
    EXPECT_GE(reference, dimmest * (1.0 - 1e-12));
    EXPECT_LT(reference, 1.25 * dimmest) << "the projector grazes the front: it counts by degrees";
}

TEST(Light, NoGainIsEverAboveOneNorBelowTheLeast) {
    Lit lit;
    std::mt19937 random(2);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    for (int k = 0; k < 2000; ++k) {
        lit.projector_from_prop.translation = {0.25 * u(random), 0.25 * u(random), 0.9};
        const glm::dvec3 eye(u(random), u(random), 0.6 + 0.3 * u(random));
        std::vector<SeenFace> seen;
        for (const PropFace& face : lit.prop.faces) {
            if (face.plane.distance(eye) > 0.0 && face.plane.distance(lit.projector()) > 0.0) {
                seen.push_back({&face, eye});
            }
        }
        const LightCompensation compensation;
        const double reference = reference_light(seen, lit.projector(), compensation);
        double brightest = 0.0;
        for (const SeenFace& s : seen) {
            const FaceLight light =
                face_light(s.face->plane, pinhole, lit.projector_from_prop.matrix(), reference, compensation);
            for (const glm::dvec3& corner : s.face->corners) {
                const auto pixel = pinhole.pixel(lit.projector_from_prop.point(corner));
                ASSERT_TRUE(pixel);
                const double g = gain(light, pinhole, *pixel);
                ASSERT_GT(g, 0.5 * compensation.least_gain);
                ASSERT_LE(g, 1.0);
                brightest = std::max(brightest, g);
            }
        }
        ASSERT_FALSE(seen.empty());
    }
}

TEST(Light, NothingJumpsWhenAFaceComesInSight) {
    const Lit lit;
    double before = -1.0;
    for (int k = 0; k <= 4000; ++k) { // the eye goes once around
        const double angle = 2.0 * 3.14159265358979 * k / 4000;
        const glm::dvec3 eye(0.5 * std::cos(angle), 0.5 * std::sin(angle), 0.3);
        std::vector<SeenFace> seen;
        for (const PropFace& face : lit.prop.faces) {
            if (face.plane.distance(eye) > 0.0) {
                seen.push_back({&face, eye});
            }
        }
        const double reference = reference_light(seen, lit.projector(), {});
        if (before > 0.0) {
            ASSERT_LT(std::abs(reference - before), 0.05 * before) << k; // 0.09 degrees a step
        }
        before = reference;
    }
}

} // namespace
} // namespace frustumscreen
