#include "app/geometry/collineation.h"
#include "app/scene/frame_plan.h"
#include "tests/solid/example_props.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace frustumscreen::scene {
namespace {

/// A closed surface of one cluster in the pack's box, and a projector that looks straight down.
struct Kiosk {
    geometry::PropShape prop = geometry::make_frustum({});
    PlacedLevel artifact;
    glm::dvec3 eye{0.05, -0.5, 0.45};
    PlanView view{
        {1280, 800, 1872.0, 1872.0, 640.0, 400.0}, {{0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.2}}, {}, {}, {}};

    Kiosk() {
        pack::PackLevel ball;
        for (const auto& [x, y, z] : {std::array{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}) {
            ball.vertices.push_back(
                {{static_cast<std::uint16_t>(65535 * x), static_cast<std::uint16_t>(65535 * y),
                  static_cast<std::uint16_t>(65535 * z)},
                 0,
                 {}});
        }
        ball.indices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 4, 2, 3, 4, 3, 1, 4}; // two tetrahedra, base to base
        pack::PackCluster all;
        all.index_count = static_cast<std::uint32_t>(ball.indices.size());
        all.centre = {0.0F, 0.0F, 0.5F};
        all.radius = 0.87F;
        ball.clusters = {all};
        // Larger than the prop, so seen through every face.
        artifact = {std::make_shared<LevelTriangles>(triangles_of(ball, glm::dvec3(1.0))),
                    glm::dvec3(1.0),
                    0.16,
                    {MeshId{1}, {TextureId{2}}}};
    }
    FramePlan plan() {
        view.eyes_m = std::span(&eye, 1);
        FramePlan result = make_plan(prop, artifact);
        plan_frame(prop, artifact, view, result);
        return result;
    }
    std::vector<int> faces() {
        std::vector<int> result;
        for (const FacePlan& face : plan().faces) {
            result.push_back(face.face);
        }
        return result;
    }
};

TEST(FramePlan, HoldsTheFacesThatTheEyeSeesAndTheProjectorLights) {
    Kiosk kiosk;
    EXPECT_EQ(kiosk.faces(), (std::vector<int>{0, 1, 3, 4})); // the sides lean back: all except the far one
    kiosk.eye = {0.5, 0.5, 0.4};
    EXPECT_EQ(kiosk.faces(), (std::vector<int>{0, 2, 4}));
    kiosk.eye = {0.0, 0.0, 2.0};
    EXPECT_EQ(kiosk.faces(), (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(FramePlan, FaceTurnedAwayFromTheProjectorStaysDark) {
    Kiosk kiosk;
    // The front leans back by 35 / 120: at 1.2 m its plane is at y = -0.08 + 0.35 = 0.27 relative to the
    // prop.
    kiosk.view.projector.cy = -100.0; // shifted, to keep the prop in the picture
    kiosk.eye = {0.0, -0.9, 0.2};
    kiosk.view.table_from_prop.translation = {0.0, -0.26, 0.0};
    EXPECT_EQ(kiosk.faces(), (std::vector<int>{3, 4}));
    kiosk.view.table_from_prop.translation = {0.0, -0.28, 0.0};
    EXPECT_EQ(kiosk.faces(), (std::vector<int>{4}));
}

/// The lens is low over a triangle's plane, and its distance from the mean of the corners decides.
TEST(FramePlan, TriangularFaceIsLitByTheAngleAtItsMiddle) {
    Kiosk kiosk;
    kiosk.prop = solid::example_prop("tetrahedron");
    const geometry::PropFace& face = kiosk.prop.faces[0];
    ASSERT_EQ(face.corners.size(), 3U);
    const glm::dvec3 middle = (face.corners[0] + face.corners[1] + face.corners[2]) / 3.0;
    kiosk.eye = middle + 0.6 * face.plane.normal;
    int lit = 0;
    for (std::size_t corner = 0; corner < 3; ++corner) {
        for (const double towards : {-1.0, 1.0}) {
            const glm::dvec3 outward = towards * glm::normalize(face.corners[corner] - middle);
            const glm::dvec3 across = glm::cross(face.plane.normal, outward);
            for (const double share : {0.99, 1.01}) {
                // It looks along the face, at its middle.
                kiosk.view.table_from_projector = {
                    glm::quat_cast(glm::dmat3(across, -face.plane.normal, -outward)),
                    middle + 0.7 * (outward + share * geometry::min_sine * face.plane.normal)};
                const std::vector<int> faces = kiosk.faces();
                const bool is_lit = std::find(faces.begin(), faces.end(), 0) != faces.end();
                EXPECT_EQ(is_lit, share > 1.0) << corner << ' ' << towards;
                lit += is_lit ? 1 : 0;
            }
        }
    }
    EXPECT_EQ(lit, 6);
}

TEST(FramePlan, BrightnessIsContinuousWhenAFaceAppears) {
    constexpr double step_m = 1e-4;
    std::mt19937 random(12);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    double most = 0.0;
    int begun = 0;
    for (int walk = 0; walk < 120; ++walk) {
        Kiosk kiosk;
        kiosk.artifact.metres_per_box = 0.06; // it appears on a face long after the eye has crossed the
                                              // face's plane
        kiosk.view.light = LightCompensation{};
        const double yaw = 3.14 * u(random);
        kiosk.view.table_from_prop = {glm::angleAxis(yaw, glm::dvec3(0, 0, 1)),
                                      {0.12 * u(random), 0.1 * u(random), 0.0}};
        const double azimuth = 3.14 * u(random);
        kiosk.eye = {0.7 * std::cos(azimuth), 0.7 * std::sin(azimuth), 0.5 + 0.2 * u(random)};
        const glm::dvec3 step = step_m * glm::normalize(glm::dvec3(u(random), u(random), u(random)));
        FramePlan before = kiosk.plan();
        for (int k = 0; k < 1000; ++k) {
            kiosk.eye += step;
            const FramePlan plan = kiosk.plan();
            begun += plan.faces.size() > before.faces.size() ? 1 : 0;
            for (const FacePlan& face : plan.faces) {
                const auto was = std::find_if(before.faces.begin(), before.faces.end(),
                                              [&](const FacePlan& other) { return other.face == face.face; });
                if (was != before.faces.end()) {
                    const double ratio = face.light.per_cubic_metre / was->light.per_cubic_metre;
                    most = std::max(most, std::abs(ratio - 1.0));
                }
            }
            before = plan;
        }
    }
    EXPECT_GT(begun, 5) << "hardly a face began to show it: these walks prove nothing";
    // A face's weight is a smooth step over a sine of 0.2, with a slope of at most 1.5 / 0.2; the eye, 0.7 m
    // away, moves by step / 0.7 rad, and nine tenths of the light depend on it.
    EXPECT_LT(most, 0.9 * 1.5 / 0.2 * step_m / 0.7 / 0.5);
}

TEST(FramePlan, IsEmptyWhenNothingIsVisible) {
    Kiosk kiosk;
    kiosk.eye = {0.0, 0.0, 0.05}; // inside the prop
    EXPECT_TRUE(kiosk.plan().faces.empty());
    EXPECT_TRUE(kiosk.plan().lit.bounds().empty());
    kiosk = Kiosk();
    kiosk.eye = {0.0, 0.0, -1.0}; // under the table
    EXPECT_TRUE(kiosk.plan().faces.empty());
    kiosk = Kiosk();
    kiosk.view.table_from_prop.translation = {5.0, 0.0, 0.0}; // outside the picture
    EXPECT_TRUE(kiosk.plan().faces.empty());
    kiosk = Kiosk();
    kiosk.view.table_from_prop.translation = {0.0, 0.0, 3.0}; // above the projector
    EXPECT_TRUE(kiosk.plan().faces.empty());
    kiosk = Kiosk();
    kiosk.view.brightness = 0.0;
    EXPECT_TRUE(kiosk.plan().faces.empty());
    kiosk = Kiosk();
    kiosk.artifact.triangles = nullptr;
    EXPECT_TRUE(kiosk.plan().faces.empty());
}

TEST(FramePlan, EveryNumberIsFiniteForAnyPose) {
    Kiosk kiosk;
    std::mt19937 random(4);
    std::normal_distribution<double> n(0.0, 1.0);
    for (int k = 0; k < 5000; ++k) {
        kiosk.eye = glm::dvec3(n(random), n(random), n(random)) * std::exp(2.0 * n(random));
        kiosk.view.table_from_prop = {glm::normalize(glm::dquat(n(random), n(random), n(random), n(random))),
                                      0.3 * glm::dvec3(n(random), n(random), n(random))};
        kiosk.view.light = LightCompensation{};
        const FramePlan plan = kiosk.plan();
        for (const Draw& draw : plan.draws) {
            for (int column = 0; column < 4; ++column) {
                for (int row = 0; row < 4; ++row) {
                    ASSERT_TRUE(std::isfinite(draw.clip_from_unit[column][row]));
                }
            }
            ASSERT_TRUE(std::isfinite(draw.pixels_per_box));
        }
        for (const FacePlan& face : plan.faces) {
            ASSERT_TRUE(std::isfinite(face.light.per_cubic_metre));
            ASSERT_GE(plan.lit.bounds().x, 0);
            ASSERT_GE(plan.lit.bounds().y, 0);
            ASSERT_LE(plan.lit.bounds().x + plan.lit.bounds().width, 1280);
            ASSERT_LE(plan.lit.bounds().y + plan.lit.bounds().height, 800);
        }
    }
}

/// The ball at a smaller scale.
PlacedLevel small_ball(const Kiosk& kiosk) {
    PlacedLevel small = kiosk.artifact;
    small.metres_per_box = 0.13;
    small.drawable = {MeshId{7}, {TextureId{8}}};
    return small;
}

TEST(FramePlan, ProjectsPointsAlongTheEyeRayOntoTheFace) {
    Kiosk kiosk;
    kiosk.view.eyes_m = std::span(&kiosk.eye, 1);
    const std::array<Part, 2> parts{Part{kiosk.artifact, {}}, Part{small_ball(kiosk), {}}};
    FramePlan plan = make_plan(kiosk.prop, 2 * kiosk.artifact.triangles->indices.size(), 2);
    plan_frame(kiosk.prop, parts, kiosk.view, plan);
    ASSERT_EQ(plan.faces.size(), 4U);
    ASSERT_EQ(plan.draws.size(), 8U);
    std::mt19937 random(6);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    int compared = 0;
    for (const Draw& draw : plan.draws) {
        const auto face = static_cast<std::size_t>(plan.faces[static_cast<std::size_t>(draw.face)].face);
        const geometry::Plane& plane = kiosk.prop.faces[face].plane;
        const double metres = draw.drawable.mesh == MeshId{7} ? 0.13 : 0.16;
        for (int k = 0; k < 500; ++k) {
            const glm::dvec3 unit(u(random), u(random), u(random));
            const glm::dvec3 x = metres * (unit - glm::dvec3(0.5, 0.5, 0.0)); // table and prop frame coincide
            const glm::dvec3 told(glm::dmat4(draw.prop_from_unit) * glm::dvec4(unit, 1.0));
            ASSERT_LT(glm::distance(told, x), 1e-7);
            const glm::dvec3 ray = x - kiosk.eye;
            const double t = -plane.distance(kiosk.eye) / glm::dot(plane.normal, ray);
            const glm::dvec3 s = kiosk.eye + t * ray;
            const glm::dvec2 pixel(640.0 + 1872.0 * s.x / (1.2 - s.z), 400.0 - 1872.0 * s.y / (1.2 - s.z));
            const glm::vec4 clip = draw.clip_from_unit * glm::vec4(glm::vec3(unit), 1.0F);
            if (glm::length(pixel) > 1500.0) {
                continue; // far outside the picture, single precision becomes visible
            }
            constexpr double close = 5e-3;
            ASSERT_NEAR((clip.x / clip.w + 1.0F) * 640.0F, pixel.x, close);
            ASSERT_NEAR((clip.y / clip.w + 1.0F) * 400.0F, pixel.y, close);
            ++compared;
        }
    }
    EXPECT_GT(compared, 2000);
}

/// A triangle just behind the front, half a millimetre below its upper edge: the top shows nothing.
TEST(FramePlan, SoftensAnEdgeTowardsAnEmptyFace) {
    Kiosk kiosk;
    kiosk.view.light = LightCompensation{.reference = 0.25, .min_share = 1.0, .hull = {}};
    const glm::dvec3 upper(0.0, kiosk.prop.faces[4].corners[0].y, kiosk.prop.faces[4].corners[0].z);
    const glm::dvec3 lower(0.0, kiosk.prop.faces[3].corners[0].y, 0.0);
    const auto behind_front = [&](double x, double share) {
        const glm::dvec3 at = glm::mix(upper, lower, share) + glm::dvec3(x, 0.0, 0.0);
        return glm::vec3((at + 1e-3 * glm::normalize(at - kiosk.eye)) / kiosk.artifact.metres_per_box);
    };
    auto triangles = std::make_shared<LevelTriangles>();
    triangles->positions = {behind_front(-0.02, 4e-3), behind_front(0.02, 4e-3), behind_front(0.0, 0.3)};
    triangles->indices = {0, 1, 2, 0, 2, 1};
    triangles->clusters = kiosk.artifact.triangles->clusters;
    triangles->clusters.front().index_count = 6;
    triangles->clusters.front().radius = 2.0F;
    find_planes(*triangles);
    find_extents(*triangles);
    kiosk.artifact.triangles = triangles;
    ASSERT_EQ(kiosk.faces(), std::vector<int>{3});
    const FramePlan plan = kiosk.plan();
    ASSERT_EQ(plan.feathers.size(), 1U);
    // The front gets less light than the top, so its gain is larger.
    EXPECT_GT(plan.feathers[0].share.x, 0.0F);
    EXPECT_LT(plan.feathers[0].share.x, 0.9F);
    EXPECT_LT(plan.feathers[0].share.y, 0.9F);
}

TEST(FramePlan, FadeDrawsTwoPartsWithComplementaryDither) {
    Kiosk kiosk;
    kiosk.view.eyes_m = std::span(&kiosk.eye, 1);
    PlacedLevel other = kiosk.artifact;
    other.drawable = {MeshId{7}, {TextureId{8}, 0.0, true}};
    FramePlan plan = make_plan(kiosk.prop, 2 * kiosk.artifact.triangles->indices.size(), 2);
    plan_frame(kiosk.prop, fade(kiosk.artifact, other, 0.25), kiosk.view, plan);
    const std::size_t faces = plan.faces.size();
    ASSERT_EQ(faces, 4U);
    ASSERT_EQ(plan.draws.size(), 2 * faces);
    std::uint32_t next = 0;
    for (std::size_t k = 0; k < plan.draws.size(); ++k) {
        const Draw& draw = plan.draws[k];
        const bool coming = k >= faces;
        EXPECT_EQ(draw.drawable.mesh, coming ? MeshId{7} : MeshId{1});
        EXPECT_TRUE(draw.shader.dithered);
        EXPECT_EQ(draw.shader.cut_out, coming);
        EXPECT_EQ(draw.dither.share, 0.25F);
        EXPECT_EQ(draw.dither.complement, !coming);
        EXPECT_EQ(draw.face, static_cast<int>(k % faces));
        EXPECT_EQ(draw.clip_from_unit, plan.draws[k % faces].clip_from_unit);
        EXPECT_EQ(draw.range.first, next); // each index belongs to one draw
        next += draw.range.count;
        EXPECT_EQ(united(plan.faces[k % faces].bounds, draw.bounds), plan.faces[k % faces].bounds);
    }
    EXPECT_EQ(next, plan.indices.size());
    const std::uint64_t hash = plan.hash;
    plan_frame(kiosk.prop, fade(kiosk.artifact, other, 0.3), kiosk.view, plan);
    EXPECT_NE(plan.hash, hash);
    plan_frame(kiosk.prop, kiosk.artifact, kiosk.view, plan);
    EXPECT_FALSE(plan.draws.front().shader.dithered);
    EXPECT_EQ(plan.draws.size(), faces);
}

TEST(FramePlan, APartShowsOnItsOwnFacesAlone) {
    Kiosk kiosk;
    kiosk.view.eyes_m = std::span(&kiosk.eye, 1);
    kiosk.artifact.faces = 0b00001;
    PlacedLevel other = small_ball(kiosk);
    other.faces = 0b11000;
    const std::array<Part, 2> parts{Part{kiosk.artifact, {}}, Part{other, {}}};
    FramePlan plan = make_plan(kiosk.prop, 2 * kiosk.artifact.triangles->indices.size(), 2);
    plan_frame(kiosk.prop, parts, kiosk.view, plan);
    ASSERT_EQ(plan.draws.size(), 3U);
    const std::array<int, 3> faces{0, 3, 4};
    for (std::size_t k = 0; k < faces.size(); ++k) {
        EXPECT_EQ(plan.faces[static_cast<std::size_t>(plan.draws[k].face)].face, faces[k]);
    }
}

TEST(FramePlan, DrawsTheCaptionFirstAndThePropInBlackOverIt) {
    Kiosk kiosk;
    const TablePicture caption{
        {glm::dvec3(0.02, 0, 0), glm::dvec3(0.2, 0, 0), glm::dvec3(0.2, -0.1, 0), glm::dvec3(0.02, -0.1, 0)},
        0.5,
        TextureId{7}};
    const std::size_t without = kiosk.plan().draws.size();
    kiosk.view.caption = caption;
    const FramePlan plan = kiosk.plan();
    // The projector is above all faces; faces away from the caption need no black.
    ASSERT_GT(plan.draws.size(), without + 1);
    ASSERT_LE(plan.draws.size(), without + 1 + kiosk.prop.faces.size());
    for (std::size_t k = 0; k < plan.draws.size(); ++k) {
        const Draw& draw = plan.draws[k];
        EXPECT_EQ(draw.face == Draw::on_table, k < plan.draws.size() - without);
        EXPECT_EQ(draw.drawable.material.texture == TextureId{7}, k == 0);
        if (draw.face == Draw::on_table) {
            EXPECT_EQ(draw.shader.pass, ShaderKey::Pass::TablePicture);
            EXPECT_EQ(draw.brightness, k == 0 ? 0.5F : 0.0F);
            EXPECT_EQ(united(draw.bounds, plan.draws[0].bounds), plan.draws[0].bounds);
        }
    }
    // Directly below the lens: u = cx + f x / h, v = cy - f y / h; clip from -1 to 1 over the picture.
    for (int k = 0; k < 4; ++k) {
        const glm::vec4 corner = plan.draws[0].clip_from_unit[k];
        const glm::dvec3& m = caption.corners_m[static_cast<std::size_t>(k)];
        EXPECT_NEAR(corner.x / corner.w, (640.0 + 1872.0 * m.x / 1.2) / 640.0 - 1.0, 1e-6);
        EXPECT_NEAR(corner.y / corner.w, (400.0 - 1872.0 * m.y / 1.2) / 400.0 - 1.0, 1e-6);
    }
    EXPECT_EQ(lit_bounds(plan), united(plan.lit.bounds(), plan.draws[0].bounds));
}

TEST(FramePlan, EachFaceHasItsOwnEye) {
    Kiosk kiosk;
    const std::array<glm::dvec3, 5> eyes{glm::dvec3(0.6, 0, 0.3), glm::dvec3(-0.6, 0, 0.3),
                                         glm::dvec3(0, 0.6, 0.3), glm::dvec3(0, -0.6, 0.3),
                                         glm::dvec3(0, 0, -1)};
    FramePlan plan = make_plan(kiosk.prop, kiosk.artifact);
    kiosk.view.eyes_m = eyes;
    plan_frame(kiosk.prop, kiosk.artifact, kiosk.view, plan);
    EXPECT_EQ(plan.faces.size(), 4U); // each side for its own visitor, the top for none
}

TEST(FramePlan, HashChangesWithThePicture) {
    Kiosk kiosk;
    const std::uint64_t hash = kiosk.plan().hash;
    EXPECT_EQ(kiosk.plan().hash, hash);
    kiosk.eye.x += 1e-5;
    EXPECT_NE(kiosk.plan().hash, hash);
    kiosk = Kiosk();
    kiosk.artifact.drawable.mesh = MeshId{3};
    EXPECT_NE(kiosk.plan().hash, hash);
    kiosk = Kiosk();
    kiosk.view.brightness = 0.5;
    EXPECT_NE(kiosk.plan().hash, hash);
    kiosk = Kiosk();
    kiosk.view.caption = TablePicture{
        {glm::dvec3(0.1, 0, 0), glm::dvec3(0.2, 0, 0), glm::dvec3(0.2, -0.1, 0), glm::dvec3(0.1, -0.1, 0)},
        1.0,
        TextureId{7}};
    const std::uint64_t captioned = kiosk.plan().hash;
    EXPECT_NE(captioned, hash);
    kiosk.view.caption->texture = TextureId{8};
    EXPECT_NE(kiosk.plan().hash, captioned);
}

} // namespace
} // namespace frustumscreen::scene
