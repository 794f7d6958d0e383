// The bench's techniques on props in the hand with faces of three, four and six corners.
#include "app/bench/setup/advice.h"
#include "app/bench/techniques/floor.h"
#include "app/bench/techniques/peers.h"
#include "tests/bench/drawn_near.h"
#include "tests/bench/ring.h"
#include "tests/solid/example_props.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace frustumscreen::bench {
namespace {

class SolidProps : public DrawnNear, public ::testing::WithParamInterface<const char*> {
protected:
    SolidProps() {
        kiosk_.prop = solid::example_prop(GetParam());
        kiosk_.settings.prop = {.kind = settings::PropKind::Solid, .zone = settings::PropZone::Hand};
        kiosk_.settings.prop.shape = std::make_shared<const geometry::PropShape>(kiosk_.prop);
        kiosk_.settings.table = {0.4, 0.25}; // about the picture on it
    }
    [[nodiscard]] std::vector<BenchPose> poses() const {
        return draw_poses(kiosk_.settings, kiosk_.prop, 5, 9).value();
    }
    /// True if the ray through the pixel's centre lights a face that the eye looks at. In the hand the projector lights
    /// other faces too; they stay dark.
    [[nodiscard]] bool lights_seen_face(int x, int y, const TruthView& view) const {
        const glm::dvec3& lens = view.prop_from_projector.translation;
        const glm::dvec3 ray = view.prop_from_projector.direction(view.projector.ray(glm::dvec2(x, y) + 0.5));
        geometry::PropHit hit;
        return geometry::intersect(kiosk_.prop, lens, ray, hit) &&
               kiosk_.prop.faces[static_cast<std::size_t>(hit.face)].plane.distance(view.eye_m) > 0.0;
    }
    std::shared_ptr<bake::SourceMesh> mesh_ = ring();
    Truth truth_ = Truth::build(mesh_, glm::dmat4(1.0)).value();
};
INSTANTIATE_TEST_SUITE_P(Examples, SolidProps, ::testing::Values("hexagon", "tetrahedron", "gem"));

TEST_P(SolidProps, TheFloorCoversTheFacesThatAreSeenAndLit) {
    const std::unique_ptr<Technique> floor = make_floor(kiosk_, FloorFilter::OneLevel).value();
    for (const BenchPose& pose : poses()) {
        floor->draw(pose);
        const image::Image8 drawn = render::read_colour(kiosk_.framebuffer, kiosk_.width(), kiosk_.height());
        const TruthView view = view_of(kiosk_.settings, pose);
        int covered = 0;
        int beside = 0;
        int missing = 0;
        for (int y = 0; y < drawn.height; ++y) {
            for (int x = 0; x < drawn.width; ++x) {
                const bool seen = lights_seen_face(x, y, view);
                const bool lit = drawn.at(x, y).r != 0;
                covered += seen ? 1 : 0;
                beside += lit && !seen ? 1 : 0;
                missing += !lit && seen ? 1 : 0;
            }
        }
        EXPECT_GT(covered, 1000);
        EXPECT_LE(beside, 4) << "pixel centres on an edge";
        EXPECT_LE(missing, covered / 100) << "the pattern has black texels";
    }
}

TEST_P(SolidProps, FullMeshMatchesTheRayCastAndTwoPassesApproximateIt) {
    const std::shared_ptr<const PeerMesh> peer = PeerMesh::upload(*mesh_, glm::dmat4(1.0)).value();
    const std::unique_ptr<Technique> full = make_full_mesh(kiosk_, peer).value();
    const std::unique_ptr<Technique> two_pass = make_two_pass(kiosk_, peer, 1024).value();
    int pixels = 0;
    for (const BenchPose& pose : poses()) {
        const TruthPicture truth = ray_cast(truth_, pose);
        const PictureError error = error_of(*full, pose, truth);
        pixels += static_cast<int>(error.truth_pixels);
        EXPECT_LT(error.outline_shift_px, 0.05);
        EXPECT_LT(error.geometric_mean_mm, 0.1);
        const PictureError twice = error_of(*two_pass, pose, truth);
        EXPECT_LT(twice.silhouette_percent, 5.0);
        EXPECT_LT(twice.geometric_mean_mm, 0.5);
    }
    EXPECT_GT(pixels, 3000);
}

/// Fans of quadrilaterals cover each face once: a prism's pixels do not depend on which corner of a face comes first.
TEST_P(SolidProps, AdvicePixelsDoNotDependOnTheFirstCorner) {
    settings::Settings turned = kiosk_.settings;
    geometry::PropShape shape = kiosk_.prop;
    for (geometry::PropFace& face : shape.faces) {
        std::rotate(face.corners.begin(), face.corners.begin() + 1, face.corners.end());
    }
    turned.prop.shape = std::make_shared<const geometry::PropShape>(shape);
    const double pixels = examine(kiosk_.settings).pixels;
    EXPECT_GT(pixels, 1000.0);
    EXPECT_NEAR(examine(turned).pixels, pixels, 0.01 * pixels);
}

} // namespace
} // namespace frustumscreen::bench
