#include "app/bench/measures/projection.h"
#include "app/bench/techniques/peers.h"
#include "app/render/read_back.h"
#include "firmware_host/display/surfaceless_display.h"
#include "tests/bench/near_settings.h"
#include "tests/bench/ring.h"
#include "tests/simulation/pixels_covered.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace frustumscreen::bench {
namespace {

simulation::VisitorScene scene_of(const settings::Settings& settings, const geometry::PropShape& prop,
                                  const BenchPose& pose) {
    return {settings.projector.pinhole,
            settings.projector.table_from_projector,
            prop,
            pose.table_from_prop,
            pose.eye_m,
            {settings.table.width_m, settings.table.depth_m}};
}

constexpr glm::dvec3 ball_centre(0.0, 0.0, 0.05);
constexpr double ball_radius_m = 0.02;

/// A fine grid of latitudes and longitudes.
std::shared_ptr<bake::SourceMesh> ball() {
    constexpr std::uint32_t around = 256;
    constexpr std::uint32_t up = 128;
    auto mesh = std::make_shared<bake::SourceMesh>();
    mesh->materials = {{glm::vec4(1.0F), -1, false, 0.5F}};
    for (std::uint32_t j = 0; j <= up; ++j) {
        for (std::uint32_t i = 0; i <= around; ++i) {
            const double a = 2.0 * std::numbers::pi * i / around;
            const double b = std::numbers::pi * j / up;
            mesh->positions.push_back(ball_centre + ball_radius_m * glm::dvec3(std::sin(b) * std::cos(a),
                                                                               std::sin(b) * std::sin(a),
                                                                               -std::cos(b)));
        }
    }
    for (std::uint32_t j = 0; j < up; ++j) {
        for (std::uint32_t i = 0; i < around; ++i) {
            const std::uint32_t k = j * (around + 1) + i;
            mesh->triangles.push_back({k, k + 1, k + around + 1});
            mesh->triangles.push_back({k + 1, k + around + 2, k + around + 1});
        }
    }
    mesh->triangle_materials.assign(mesh->triangles.size(), 0);
    return mesh;
}

TEST(Projection, VisitorsRayCastHitsABallWhereAlgebraPredicts) {
    const BenchPose pose = pose_at(0.03, 0.02, 0.8);
    const geometry::PropShape prop = geometry::make_frustum({});
    const simulation::VisitorScene scene = scene_of(near_settings(), prop, pose);
    const auto truth = Truth::build(ball(), glm::dmat4(1.0));
    ASSERT_TRUE(truth) << truth.error().message;
    const simulation::VisitorCamera camera =
        simulation::visitor_camera(prop, pose.table_from_prop, pose.eye_m, 320, 240);
    const VisitorTruth picture = cast_visitor(*truth, scene, camera, 1);
    const glm::dvec3 centre = pose.table_from_prop.point(ball_centre);
    int judged = 0;
    for (int y = 0; y < 240; ++y) {
        for (int x = 0; x < 320; ++x) {
            const glm::dvec3 ray =
                glm::normalize(camera.table_from_camera.direction(camera.pinhole.ray({x + 0.5, y + 0.5})));
            const double beside = glm::length(glm::cross(ray, centre - pose.eye_m));
            if (picture.prop.at(x, y) == 0 || std::abs(beside - ball_radius_m) < 2e-5) {
                continue; // the polyhedron's outline lies inside the ball's
            }
            const bool hit = beside < ball_radius_m;
            judged += hit ? 1 : 0;
            EXPECT_EQ(picture.hit.at(x, y), hit ? 1 : 0) << x << " " << y;
            EXPECT_EQ(picture.colour.at(x, y).r, hit ? 255 : 0) << x << " " << y;
        }
    }
    EXPECT_GT(judged, 200);
}

TEST(Projection, CountsCorrectPixelsOnThePropAndOnTheArtifact) {
    VisitorTruth truth{{4, 1, 1}, {4, 1}, {4, 1, glm::u8vec4(0, 0, 0, 255)}};
    truth.prop.at(3, 0) = 0;
    truth.hit.at(0, 0) = truth.hit.at(1, 0) = 1;
    truth.colour.at(0, 0) = truth.colour.at(1, 0) = {100, 100, 100, 255};
    image::Image8 view(4, 1, glm::u8vec4(0, 0, 0, 255));
    view.at(0, 0) = {116, 100, 84, 255};  // 16 codes off: right
    view.at(1, 0) = {100, 117, 100, 255}; // 17: wrong
    view.at(3, 0) = {255, 255, 255, 255}; // outside the prop
    const PixelAccuracy found = pixel_accuracy(view, truth);
    EXPECT_EQ(found.prop_pixels, 3);
    EXPECT_EQ(found.prop_right, 2);
    EXPECT_EQ(found.artifact_pixels, 2);
    EXPECT_EQ(found.artifact_right, 1);
    EXPECT_DOUBLE_EQ(found.artifact_percent(), 50.0);
}

TEST(Projection, NoPixelOfTheVisitorsPictureIsFinerThanTheProjectors) {
    const geometry::PropShape prop = geometry::make_frustum({});
    for (const double yaw : {0.0, 0.4, 0.785}) {
        const simulation::VisitorScene scene = scene_of(near_settings(), prop, pose_at(0.05, -0.04, yaw));
        const simulation::VisitorCamera camera = no_finer_camera(scene);
        int seen = 0;
        for (int y = 0; y < camera.pinhole.height; ++y) {
            for (int x = 0; x < camera.pinhole.width; ++x) {
                const double covered =
                    simulation::projector_pixels_covered(scene, camera, {x + 0.5, y + 0.5});
                seen += covered > 0.0 ? 1 : 0;
                EXPECT_TRUE(covered == 0.0 || covered >= 1.0) << covered << " at " << x << " " << y;
            }
        }
        EXPECT_GT(seen, 300);
    }
}

/// The percentage of the prop's pixels that are right if the ring is projected for `drawn` and the prop
/// stands at `stands`.
class ProjectedRing : public ::testing::Test {
protected:
    [[nodiscard]] static double right_percent(const BenchPose& drawn, const BenchPose& stands) {
        auto display = display::SurfacelessDisplay::create(640, 400);
        const Kiosk kiosk{near_settings(), geometry::make_frustum({}), (*display)->framebuffer()};
        auto mesh = std::make_shared<bake::SourceMesh>(*ring());
        auto peer = PeerMesh::upload(*mesh, glm::dmat4(1.0));
        auto full = make_full_mesh(kiosk, *peer);
        (*full)->draw(drawn);
        const image::Image8 picture = render::read_colour(kiosk.framebuffer, 640, 400);
        const simulation::VisitorScene scene = scene_of(kiosk.settings, kiosk.prop, stands);
        const simulation::VisitorCamera camera = no_finer_camera(scene);
        simulation::VisitorViewOptions sixteen = simulation::exact_check();
        sixteen.rays_per_side = 4;
        const auto truth = Truth::build(mesh, glm::dmat4(1.0));
        return pixel_accuracy(simulation::visitor_view(scene, picture, camera, sixteen),
                              cast_visitor(*truth, scene, camera, 4))
            .prop_percent();
    }
};

TEST_F(ProjectedRing, MatchesTheVisitorsRayCast) {
    const BenchPose pose = pose_at(0.02, 0.01, 0.3);
    EXPECT_GE(right_percent(pose, pose), min_right_percent);
}

TEST_F(ProjectedRing, DetectsAShiftedPropOrEye) {
    const BenchPose pose = pose_at(0.02, 0.01, 0.3);
    BenchPose shifted = pose;
    shifted.table_from_prop.translation.x += 0.005;
    EXPECT_LT(right_percent(pose, shifted), min_right_percent);
    shifted = pose;
    shifted.eye_m.x += 0.2;
    EXPECT_LT(right_percent(pose, shifted), min_right_percent);
}

} // namespace
} // namespace frustumscreen::bench
