#include "app/geometry/transform.h"
#include "app/scene/light.h"
#include "app/settings/light_range.h"
#include "app/settings/lit_zone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

namespace frustumscreen::scene {
namespace {

const geometry::Pinhole pinhole{1280, 800, 1900.0, 1850.0, 600.0, 450.0};

struct Lit {
    geometry::PropShape prop = geometry::make_frustum({});
    geometry::RigidTransform projector_from_prop{{0.0, 1.0, 0.0, 0.0}, {0.03, -0.02, 0.9}}; // looking down
    glm::dvec3 projector() const { return projector_from_prop.inverse().translation; }
};

TEST(Light, GainTimesReceivedLightEqualsTheReference) {
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

TEST(Light, KeepsTheReferenceThatEveryFaceReaches) {
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

TEST(Light, IgnoresAFaceThatIsNotVisible) {
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

/// A box as the artifact.
struct BoxArtifact {
    glm::dvec3 low{-0.05, -0.035, 0.0};
    glm::dvec3 high{0.05, 0.035, 0.1};

    [[nodiscard]] std::shared_ptr<const std::vector<glm::dvec3>> hull() const {
        std::vector<glm::dvec3> corners;
        for (unsigned k = 0; k < 8; ++k) {
            corners.emplace_back((k & 1U) != 0 ? high.x : low.x, (k & 2U) != 0 ? high.y : low.y,
                                 (k & 4U) != 0 ? high.z : low.z);
        }
        return std::make_shared<const std::vector<glm::dvec3>>(std::move(corners));
    }
    /// True if the ray meets the box: the distances at which it is between each pair of sides overlap.
    [[nodiscard]] bool meets(const glm::dvec3& eye, const glm::dvec3& ray) const {
        const glm::dvec3 a = (low - eye) / ray;
        const glm::dvec3 b = (high - eye) / ray;
        const glm::dvec3 in = glm::min(a, b);
        const glm::dvec3 out = glm::max(a, b);
        return std::max({in.x, in.y, in.z}) < std::min({out.x, out.y, out.z});
    }
};

/// For each face of the prop: the share of the rays to the artifact that enter through it, and the least light that one
/// of them meets there. The rays are a grid in the picture of a pinhole at the eye.
struct RayCast {
    std::array<double, 5> share{};
    std::array<double, 5> light{};
    double darkest = 1e9; ///< of all places through which the artifact is seen

    RayCast(const geometry::PropShape& prop, const BoxArtifact& artifact, const glm::dvec3& eye,
            const glm::dvec3& lens) {
        light.fill(1e9);
        const glm::dvec3 forward = glm::normalize(0.5 * (artifact.low + artifact.high) - eye);
        const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.1, 0.2, 1.0)));
        const glm::dvec3 up = glm::cross(right, forward);
        constexpr int across = 300;
        const double half = 0.09 / glm::distance(eye, 0.5 * (artifact.low + artifact.high));
        int rays = 0;
        for (int k = 0; k < across * across; ++k) {
            const double x = half * ((k % across + 0.5) / across * 2.0 - 1.0);
            const double y = half * ((std::floor(k / across) + 0.5) / across * 2.0 - 1.0);
            const glm::dvec3 ray = forward + x * right + y * up;
            if (!artifact.meets(eye, ray)) {
                continue;
            }
            ++rays;
            // The last of the planes that the ray passes from outside.
            double t = -1.0;
            std::size_t face = 0;
            for (std::size_t each = 0; each < prop.faces.size(); ++each) {
                const geometry::Plane& plane = prop.faces[each].plane;
                const double at = -plane.distance(eye) / glm::dot(plane.normal, ray);
                if (plane.distance(eye) > 0.0 && at > t) {
                    t = at;
                    face = each;
                }
            }
            const glm::dvec3 to_lens = lens - (eye + t * ray);
            const double received =
                glm::dot(prop.faces[face].plane.normal, to_lens) / std::pow(glm::length(to_lens), 3.0);
            share.at(face) += 1.0;
            light.at(face) = std::min(light.at(face), received);
            darkest = std::min(darkest, received);
        }
        for (double& each : share) {
            each /= rays;
        }
    }
};

/// A random eye and place of the shipped prop, up to the table's edges.
struct Pose {
    glm::dvec3 eye{0.0};  ///< prop frame
    glm::dvec3 lens{0.0}; ///< prop frame

    explicit Pose(std::mt19937& random) {
        std::uniform_real_distribution<double> u(-1.0, 1.0);
        const geometry::RigidTransform table_from_prop{
            glm::angleAxis(std::numbers::pi * u(random), glm::dvec3(0, 0, 1)),
            {0.29 * u(random), 0.14 * u(random), 0.0}};
        lens = table_from_prop.inverse().point({0.0, 0.0, 1.5});
        const double azimuth = std::numbers::pi * u(random);
        const double elevation = 0.8 + 0.5 * u(random);
        eye = (0.75 + 0.35 * u(random)) * glm::dvec3(std::cos(elevation) * std::cos(azimuth),
                                                     std::cos(elevation) * std::sin(azimuth),
                                                     std::sin(elevation));
    }
};

/// The rays decide: the artifact dims for the places through which rays to it enter, and not for dark corners.
TEST(Light, KnownArtifactDimsByThePlacesItIsSeenThrough) {
    const settings::Settings shipped;
    const geometry::PropShape prop = settings::make_prop(shipped.prop);
    const BoxArtifact artifact;
    LightCompensation by_faces{settings::even_light(shipped), 0.3};
    LightCompensation by_artifact = by_faces;
    by_artifact.hull = artifact.hull();
    std::mt19937 random(7);
    int other = 0;
    int dimmed = 0;
    for (int k = 0; k < 150; ++k) {
        const Pose pose(random);
        // The shipped light reaches nearly every place that is seen; half of the poses want more.
        by_faces.reference = by_artifact.reference = (k % 2 == 0 ? 1.0 : 1.7) * settings::even_light(shipped);
        const double faces = reference_light(all_faces(prop, pose.eye), pose.lens, by_faces);
        const double seen = reference_light(all_faces(prop, pose.eye), pose.lens, by_artifact);
        const RayCast rays(prop, artifact, pose.eye, pose.lens);
        double expected = 1.0;
        for (std::size_t face = 0; face < prop.faces.size(); ++face) {
            const double reached = std::clamp(rays.light.at(face) / by_artifact.reference, 0.3, 1.0);
            expected = std::min(expected, std::pow(reached, std::min(1.0, 4.0 * rays.share.at(face))));
        }
        EXPECT_NEAR(seen / by_artifact.reference, expected, 0.005) << k;
        if (rays.darkest >= by_artifact.reference) {
            EXPECT_EQ(seen, by_artifact.reference) << k << ": each ray gets the light that is aimed at";
            other += faces < 0.99 * by_artifact.reference ? 1 : 0;
        }
        dimmed += expected < 0.99 ? 1 : 0;
    }
    EXPECT_GT(other, 10) << "by its corners a face would have dimmed the artifact";
    EXPECT_GT(dimmed, 20);
}

/// A step of a tenth of a millimetre changes the light by at most a thousandth, also while the artifact comes to show
/// on another face.
TEST(Light, AKnownArtifactDimsGraduallyAsTheEyeMoves) {
    const Lit lit; // a steep prop: its sides get a third of the top's light
    const double aim = 0.9 * settings::received_light(lit.prop.faces[4].plane, {0, 0, 0.12}, lit.projector());
    BoxArtifact artifact;
    artifact.low = {-0.04, -0.04, 0.0};
    artifact.high = {0.04, 0.04, 0.1};
    const LightCompensation compensation{aim, 0.3, artifact.hull()};
    double before = -1.0;
    double least = 1.0;
    double most = 0.0;
    for (int step = 0; step <= 18'000; ++step) { // over the prop, from low before it to low behind it
        const double turn = 1e-4 * step / 0.6;
        const glm::dvec3 eye(0.01, -0.6 * std::cos(turn), 0.06 + 0.6 * std::sin(turn));
        const double share = reference_light(all_faces(lit.prop, eye), lit.projector(), compensation) / aim;
        if (before >= 0.0) {
            EXPECT_LT(std::abs(share - before), 1e-3) << step;
        }
        least = std::min(least, share);
        most = std::max(most, share);
        before = share;
    }
    EXPECT_LT(least, 0.5);
    EXPECT_GT(most, 0.9) << "from above the artifact is seen through the top";
}

TEST(Light, FaceFadesOutInGrazingLight) {
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
