#include "app/bench/techniques/peers.h"
#include "app/bench/techniques/supersampled.h"
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
        EXPECT_LT(error.geometric_p95_mm, 0.002); // 16 bits a coordinate are 0.0012 mm apart
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
        EXPECT_LT(b.sixteen_rays.rmse, 7.0);
    }
}

TEST_F(Peers, SeveralSamplesComeNearerToSixteenRaysAtTheSamePlaces) {
    const auto poses = draw_poses(stage_.settings, stage_.prop, 2, 8);
    ASSERT_TRUE(poses);
    auto one = make_full_mesh(stage_, peer_);
    ASSERT_TRUE(one);
    for (const int samples : {2, 4, 8}) {
        const Result<std::unique_ptr<Technique>> several = make_supersampled(
            stage_, samples, [&](const Stage& stage) { return make_full_mesh(stage, peer_); });
        ASSERT_TRUE(several);
        EXPECT_NE((*several)->name().find(std::to_string(samples)), std::string::npos);
        for (const BenchPose& pose : *poses) {
            const TruthPicture truth = ray_cast(truth_, pose);
            const PictureError a = error_of(**one, pose, truth);
            const PictureError b = error_of(**several, pose, truth);
            EXPECT_LT(b.sixteen_rays.rmse, 0.8 * a.sixteen_rays.rmse) << samples;
            EXPECT_LT(b.picture_shift_px, 0.05) << samples;
            EXPECT_EQ(b.geometric_mean_mm, a.geometric_mean_mm);
            EXPECT_EQ(b.mismatched_pixels, a.mismatched_pixels);
        }
    }
}

} // namespace
} // namespace frustumscreen
