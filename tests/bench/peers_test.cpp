#include "app/bench/techniques/peers.h"
#include "tests/bench/drawn_near.h"
#include "tests/bench/ring.h"

#include <gtest/gtest.h>

namespace frustumscreen {
namespace {

class Peers : public DrawnNear {
protected:
    std::shared_ptr<SourceMesh> mesh_ = ring();
    Truth truth_ = Truth::build(mesh_, glm::dmat4(1.0)).value();
    std::shared_ptr<const PeerMesh> peer_ = PeerMesh::upload(*mesh_, glm::dmat4(1.0)).value();
};

TEST_F(Peers, TheFullMeshThroughTheCollineationIsTheRayCast) {
    auto full = make_full_mesh(stage_, peer_);
    ASSERT_TRUE(full);
    const auto poses = draw_poses(stage_.settings, stage_.prop, 6, 5);
    ASSERT_TRUE(poses);
    for (const BenchPose& pose : *poses) {
        const PictureError error = error_of(**full, pose, ray_cast(truth_, pose));
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
    auto coarse = make_two_pass(stage_, peer_, 128);
    auto fine = make_two_pass(stage_, peer_, 1024);
    ASSERT_TRUE(coarse && fine);
    for (const BenchPose& pose : *poses) {
        const TruthPicture truth = ray_cast(truth_, pose);
        const PictureError a = error_of(**coarse, pose, truth);
        const PictureError b = error_of(**fine, pose, truth);
        EXPECT_LT(b.silhouette_percent, a.silhouette_percent);
        EXPECT_LT(b.geometric_mean_mm, a.geometric_mean_mm);
        EXPECT_LT(b.silhouette_percent, 2.0);
        EXPECT_LT(b.geometric_mean_mm, 0.2);
        EXPECT_LT(b.sixteen_rays.rmse, 6.0);
    }
}

} // namespace
} // namespace frustumscreen
