// The picture as shown by the kiosk, lit and with its samples, against the truth's rays, whose light is
// computed at each ray's point.

#include "app/bench/measures/comparison.h"
#include "app/render/read_back.h"
#include "assets_baked/bake/bake.h"
#include "tests/bench/drawn_near.h"
#include "tests/bench/ring.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace frustumscreen::bench {
namespace {

class ShownPictureTest : public DrawnNear {
protected:
    void SetUp() override { mesh_->default_up = 'z'; }
    /// Bakes the ring with `share` of its colour. Dim artifacts get a higher exposure.
    void bake_in(float share) {
        mesh_->materials[0].base_colour = glm::vec4(glm::vec3(share), 1.0F);
        bake::BakeOptions options;
        options.size = 96;
        options.unlit = true;
        options.measuring = 0.05;
        Result<pack::Pack> pack = bake::bake(*mesh_, options);
        ASSERT_TRUE(pack) << pack.error().message;
        pack_ = std::move(*pack);
    }

    /// Errors of the pack's level and its finest relief; the worst of several poses.
    struct Errors {
        ShownError level, relief;
    };
    [[nodiscard]] Errors errors_of(std::uint32_t level, int samples) const {
        PictureOptions options;
        options.samples = samples;
        Result<Comparison> opened =
            open_comparison({"near", kiosk_.settings}, pack_, std::vector{level}, mesh_, {options, 3, 3});
        EXPECT_TRUE(opened && opened->set->add_finest_relief(pack_, options) &&
                    opened->set->measure_errors(opened->truth, opened->poses, 0, [](double) {}));
        Errors errors;
        for (const TechniqueResult& result : opened->set->results()) {
            EXPECT_EQ(result.error.worst.shown.has_value(), result.kind != TechniqueKind::Floor);
            if (result.kind == TechniqueKind::Floor) {
                continue;
            }
            const ShownError& worst = *result.error.worst.shown;
            std::printf(
                "%s, %d samples: cover %.4f px, of its samples %.4f, bias %.4f, shift %.4f px, RMSE %.3f\n",
                result.name.c_str(), result.samples, worst.cover_px, worst.cover_of_samples_px,
                worst.cover_bias_px, worst.shift_px, worst.colour.rmse);
            (result.kind == TechniqueKind::PackLevel ? errors.level : errors.relief) = worst;
        }
        return errors;
    }
    [[nodiscard]] std::uint32_t finest() const { return static_cast<std::uint32_t>(pack_.levels.size() - 1); }

    std::shared_ptr<bake::SourceMesh> mesh_ = ring();
    pack::Pack pack_;
};

TEST_F(ShownPictureTest, LightSoftEdgesAndCoverageMatchTheTruth) {
    for (const auto& [k1, share] : {std::pair(0.0, 1.0F), std::pair(0.1, 0.15F)}) {
        kiosk_.settings.projector.pinhole.lens = {k1, 0.0};
        bake_in(share);
        const Errors errors = errors_of(finest(), 16);
        EXPECT_LT(errors.level.colour.rmse, 1.0);
        EXPECT_LT(errors.level.shift_px, 0.05);
        EXPECT_LT(errors.level.cover_px, 0.01);
        EXPECT_LT(errors.level.cover_bias_px, 0.005);
        EXPECT_LT(errors.relief.colour.rmse, 1.5);
        EXPECT_LT(errors.relief.shift_px, 0.05);
        EXPECT_LT(errors.relief.cover_px, 0.1);
    }
}

TEST_F(ShownPictureTest, FewSamplesErrAsMuchAsExactRaysAtTheirPlaces) {
    bake_in(1.0F);
    const Errors errors = errors_of(pack_.default_level, 2);
    for (const ShownError& error : {errors.level, errors.relief}) {
        EXPECT_NEAR(error.cover_of_samples_px, 0.15, 0.05); // 1 / 8 px on average; this is the worst pose
        EXPECT_NEAR(error.cover_px, error.cover_of_samples_px, 0.05);
        EXPECT_LT(error.cover_bias_px, 0.05);
    }
}

/// Light other than the target, and edges that are wrongly soft, must be detected.
TEST_F(ShownPictureTest, DetectsWrongExposureAndSharpEdges) {
    bake_in(1.0F);
    const Result<Comparison> opened =
        open_comparison({"near", kiosk_.settings}, pack_, {}, mesh_, {{}, 1, 3});
    const BenchPose& pose = opened->poses.front();
    const Kiosk& kiosk = opened->set->kiosk();
    PictureOptions options;
    options.samples = 16;
    const auto level = make_pack_level(kiosk, pack_, finest(), options, "finest").value();
    ShownPicture& shown = *level->as_shown();
    shown.draw_shown(pose);
    const auto read = [&] { return render::read_colour(kiosk.framebuffer, kiosk.width(), kiosk.height()); };
    ShownImages images{read(), {}, shown.draw_white(pose)};
    ASSERT_EQ(images.samples, 16);
    images.white = read();
    const image::ImageFloat points = level->hit_points(pose).value();
    const TruthView view = view_of(kiosk.settings, pose);
    const auto error_in = [&](const LightAim& aim) {
        const TruthPicture truth = opened->truth.cast(kiosk.prop, view, true, &aim);
        return measure_shown(truth, images, opened->truth.cover(kiosk.prop, view, truth, {4, 4}), points);
    };
    const LightAim aim = shown.light(pose);
    EXPECT_LT(error_in(aim).colour.rmse, 1.0);
    LightAim brighter = aim;
    brighter.exposure *= 1.1; // codes that are about 4 % larger
    EXPECT_GT(error_in(brighter).colour.rmse, 3.0);
    LightAim sharp = aim;
    sharp.soft_edges = false;
    EXPECT_GT(error_in(sharp).colour.rmse, 1.0);
    EXPECT_GT(error_in(sharp).shift_px, 0.05);
}

} // namespace
} // namespace frustumscreen::bench
