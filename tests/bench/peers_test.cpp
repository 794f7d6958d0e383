#include "app/bench/techniques/peers.h"
#include "app/bench/techniques/ray_cast.h"
#include "tests/bench/drawn_near.h"
#include "tests/bench/ring.h"

#include <gtest/gtest.h>

#include <array>

namespace frustumscreen::bench {
namespace {

class Peers : public DrawnNear {
protected:
    std::shared_ptr<bake::SourceMesh> mesh_ = ring();
    Truth truth_ = Truth::build(mesh_, glm::dmat4(1.0)).value();
    std::shared_ptr<const PeerMesh> peer_ = PeerMesh::upload(*mesh_, glm::dmat4(1.0)).value();
};

TEST_F(Peers, FullMeshThroughTheCollineationMatchesTheRayCast) {
    auto full = make_full_mesh(kiosk_, peer_);
    ASSERT_TRUE(full);
    const auto poses = draw_poses(kiosk_.settings, kiosk_.prop, 6, 5);
    ASSERT_TRUE(poses);
    for (const BenchPose& pose : *poses) {
        const PictureError error = error_of(**full, pose, ray_cast(truth_, pose));
        EXPECT_GT(error.truth_pixels, 300);
        EXPECT_LT(error.outline_shift_px, 0.01);
        EXPECT_LT(error.geometric_p95_mm, 0.002); // steps of 16 bits per coordinate are 0.0012 mm
        EXPECT_LT(error.geometric_mean_mm, 0.05); // a pixel on an inner edge may show the far rim instead
        EXPECT_LT(error.one_ray.rmse, 6.0);       // mipmaps
    }
}

TEST_F(Peers, TwoPassErrorShrinksWithALargerEyeImage) {
    const auto poses = draw_poses(kiosk_.settings, kiosk_.prop, 4, 6);
    ASSERT_TRUE(poses);
    auto coarse = make_two_pass(kiosk_, peer_, 128);
    auto fine = make_two_pass(kiosk_, peer_, 1024);
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

TEST_F(Peers, MoreSamplesReduceColourErrorWithoutMovingPoints) {
    const auto poses = draw_poses(kiosk_.settings, kiosk_.prop, 2, 8);
    ASSERT_TRUE(poses);
    auto one = make_full_mesh(kiosk_, peer_);
    ASSERT_TRUE(one);
    for (const int samples : {2, 4, 8}) {
        const auto grid = PeerSamples::create(kiosk_, samples);
        ASSERT_TRUE(grid);
        const Result<std::unique_ptr<Technique>> several = make_full_mesh(kiosk_, peer_, *grid);
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

/// Only lit pixels are cleared: nothing of the previous pose may remain.
TEST_F(Peers, APictureDoesNotDependOnTheOneBefore) {
    const auto poses = draw_poses(kiosk_.settings, kiosk_.prop, 3, 9);
    ASSERT_TRUE(poses);
    const auto grid = PeerSamples::create(kiosk_, 4);
    ASSERT_TRUE(grid);
    for (const auto& samples : {std::shared_ptr<const PeerSamples>(), *grid}) {
        const auto full = [&] { return make_full_mesh(kiosk_, peer_, samples).value(); };
        const auto two = [&] { return make_two_pass(kiosk_, peer_, 256, samples).value(); };
        const std::array used = {full(), two()};
        for (const BenchPose& pose : *poses) {
            const std::array fresh = {full(), two()};
            for (std::size_t k = 0; k < used.size(); ++k) {
                used[k]->draw(pose);
                const image::Image8 after_others =
                    render::read_colour(kiosk_.framebuffer, kiosk_.width(), kiosk_.height());
                fresh[k]->draw(pose);
                const image::Image8 alone =
                    render::read_colour(kiosk_.framebuffer, kiosk_.width(), kiosk_.height());
                EXPECT_TRUE(after_others.texels == alone.texels) << used[k]->name();
            }
        }
    }
}

TEST_F(Peers, MoreRayCastSamplesReduceColourError) {
    const auto poses = draw_poses(kiosk_.settings, kiosk_.prop, 2, 8);
    ASSERT_TRUE(poses);
    for (const BenchPose& pose : *poses) {
        const TruthPicture truth = ray_cast(truth_, pose);
        double before = 1e9;
        for (const int samples : {1, 2, 4, 8}) {
            const auto cast = make_ray_cast(kiosk_, truth_.traced(), samples);
            ASSERT_TRUE(cast);
            const PictureError error = error_of(**cast, pose, truth);
            EXPECT_LT(error.sixteen_rays.rmse, 0.85 * before) << samples;
            if (samples > 1) { // one ray per pixel gives too little information about places between pixels
                EXPECT_LT(error.picture_shift_px, 0.05) << samples;
            }
            before = error.sixteen_rays.rmse;
        }
    }
}

} // namespace
} // namespace frustumscreen::bench
