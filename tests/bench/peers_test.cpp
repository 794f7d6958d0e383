#include "app/bench/measure.h"
#include "app/bench/peers.h"
#include "app/render/read_back.h"
#include "firmware_host/display/surfaceless_display.h"
#include "tests/bench/near_stage.h"
#include "tests/bench/ring.h"

#include <gtest/gtest.h>

namespace frustumscreen {
namespace {

class Peers : public ::testing::Test {
protected:
    void SetUp() override {
        auto display = SurfacelessDisplay::create(640, 400);
        ASSERT_TRUE(display) << display.error().message;
        display_ = std::move(*display);
        stage_ = {near_settings(), make_prop({}), display_->framebuffer()};
        mesh_ = ring();
        auto uploaded = PeerMesh::upload(*mesh_, glm::dmat4(1.0));
        ASSERT_TRUE(uploaded) << uploaded.error().message;
        peer_ = std::move(*uploaded);
    }

    [[nodiscard]] PictureError error_of(Technique& technique, const BenchPose& pose) const {
        const auto truth = Truth::build(mesh_, glm::dmat4(1.0));
        const TruthPicture picture = truth->cast(stage_.prop, view_of(stage_.settings, pose), true);
        technique.draw(pose);
        Image8 colour = read_colour(stage_.framebuffer, 640, 400);
        auto points = technique.hit_points(pose);
        EXPECT_TRUE(points);
        return measure(picture, {std::move(colour), std::move(*points)});
    }

    std::unique_ptr<SurfacelessDisplay> display_;
    Stage stage_;
    std::shared_ptr<SourceMesh> mesh_;
    std::unique_ptr<PeerMesh> peer_;
};

TEST_F(Peers, TheFullMeshThroughTheCollineationIsTheRayCast) {
    auto full = make_full_mesh(stage_, *peer_);
    ASSERT_TRUE(full);
    const auto poses = draw_poses(stage_.settings, stage_.prop, 6, 5);
    ASSERT_TRUE(poses);
    for (const BenchPose& pose : *poses) {
        const PictureError error = error_of(**full, pose);
        EXPECT_GT(error.truth_pixels, 300);
        EXPECT_LT(error.outline_shift_px, 0.01);
        EXPECT_LT(error.geometric_p95_mm, 0.001);
        EXPECT_LT(error.geometric_mean_mm, 0.05); // a pixel on an inner edge may show the far rim instead
        EXPECT_LT(error.one_ray.rmse, 6.0);       // mipmaps
    }
}

TEST_F(Peers, TwoPassesComeNearerToTheRayCastWithALargerEyeImage) {
    const auto poses = draw_poses(stage_.settings, stage_.prop, 4, 6);
    ASSERT_TRUE(poses);
    auto coarse = make_two_pass(stage_, *peer_, 128);
    auto fine = make_two_pass(stage_, *peer_, 1024);
    ASSERT_TRUE(coarse && fine);
    for (const BenchPose& pose : *poses) {
        const PictureError a = error_of(**coarse, pose);
        const PictureError b = error_of(**fine, pose);
        EXPECT_LT(b.silhouette_percent, a.silhouette_percent);
        EXPECT_LT(b.geometric_mean_mm, a.geometric_mean_mm);
        EXPECT_LT(b.silhouette_percent, 2.0);
        EXPECT_LT(b.geometric_mean_mm, 0.2);
        EXPECT_LT(b.sixteen_rays.rmse, 6.0);
    }
}

} // namespace
} // namespace frustumscreen
