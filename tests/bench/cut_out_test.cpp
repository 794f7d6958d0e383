#include "app/bench/techniques/pack_level.h"
#include "app/pack/pack_relief.h"
#include "assets_baked/bake/bake.h"
#include "tests/bench/drawn_near.h"

#include <gtest/gtest.h>

namespace frustumscreen::bench {
namespace {

/// An upright rectangle perpendicular to Y at `y_m`, from the table up; its texture's u runs along X.
void add_board(bake::SourceMesh& mesh, double y_m, std::int32_t material) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::dvec2 corner : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)}) {
        mesh.positions.emplace_back(0.06 * (corner.x - 0.5), y_m, 0.07 * corner.y);
        mesh.uvs.emplace_back(static_cast<float>(corner.x), static_cast<float>(corner.y));
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
    mesh.triangle_materials.insert(mesh.triangle_materials.end(), 2, static_cast<std::uint32_t>(material));
}

/// Six red pickets in a row, with an arch cut out of their middle; the cut-out texels are bright green and
/// must stay invisible.
std::shared_ptr<const image::Image8> pickets() {
    auto image = std::make_shared<image::Image8>(192, 192);
    for (int y = 0; y < 192; ++y) {
        for (int x = 0; x < 192; ++x) {
            const bool between = x % 32 >= 18;
            const bool arch = glm::distance(glm::vec2(x, y), glm::vec2(96, 96)) < 30.0F;
            image->at(x, y) = between || arch ? glm::u8vec4(0, 255, 0, 20) : glm::u8vec4(200, 40, 30, 255);
        }
    }
    return image;
}

std::shared_ptr<bake::SourceMesh> fence(bool with_wall) {
    auto mesh = std::make_shared<bake::SourceMesh>();
    mesh->textures = {{pickets(), bake::Wrap::Clamp, bake::Wrap::Clamp}};
    mesh->materials = {{glm::vec4(1.0F), 0, true, 0.3F},
                       {glm::vec4(0.05F, 0.1F, 0.8F, 1.0F), -1, false, 0.5F}};
    add_board(*mesh, -0.01, 0);
    if (with_wall) {
        add_board(*mesh, 0.01, 1);
    }
    mesh->default_up = 'z';
    return mesh;
}

class CutOut : public DrawnNear {
protected:
    void bake_fence(bool with_wall, bool relief = false) {
        mesh_ = fence(with_wall);
        bake::BakeOptions options;
        options.size = 512;
        options.unlit = true;
        options.relief = relief;
        options.measuring = 0.05;
        Result<pack::Pack> pack = bake::bake(*mesh_, options);
        ASSERT_TRUE(pack) << pack.error().message;
        pack_ = std::move(*pack);
    }

    [[nodiscard]] PictureError error_of(std::uint32_t level, const BenchPose& pose) {
        auto technique = make_pack_level(kiosk_, pack_, level, {render::finest_samples}, "level").value();
        const Truth truth = Truth::build(mesh_, pack::place(pack_, kiosk_.prop).prop_from_artifact).value();
        return DrawnNear::error_of(*technique, pose, ray_cast(truth, pose));
    }

    std::shared_ptr<bake::SourceMesh> mesh_;
    pack::Pack pack_;
};

TEST_F(CutOut, FenceKeepsItsGapsAtDefaultAndFinestLevel) {
    ASSERT_NO_FATAL_FAILURE(bake_fence(false));
    const auto poses = draw_poses(kiosk_.settings, kiosk_.prop, 6, 3);
    ASSERT_TRUE(poses);
    for (const std::uint32_t level :
         {pack_.default_level, static_cast<std::uint32_t>(pack_.levels.size() - 1)}) {
        EXPECT_TRUE(image::has_cut_texels(pack_.textures[pack_.levels[level].texture]));
        for (const BenchPose& pose : *poses) {
            const PictureError error = error_of(level, pose);
            EXPECT_TRUE(error.silhouette_percent <= 0.6 || error.outline_shift_px <= 0.2)
                << error.silhouette_percent << " % " << error.outline_shift_px << " px";
        }
    }
}

TEST_F(CutOut, ShowsTheBackgroundThroughGapsWithoutAFringe) {
    ASSERT_NO_FATAL_FAILURE(bake_fence(true));
    const auto finest = static_cast<std::uint32_t>(pack_.levels.size() - 1);
    const auto poses = draw_poses(kiosk_.settings, kiosk_.prop, 6, 3);
    ASSERT_TRUE(poses);
    for (const BenchPose& pose : *poses) {
        const PictureError error = error_of(finest, pose);
        EXPECT_GT(error.truth_pixels, 50);
        EXPECT_LT(error.sixteen_rays.rmse, 14.0); // the green of the cut-out texels would be 100 and more
        EXPECT_LT(error.geometric_mean_mm, 0.5);  // the boards are 20 mm apart
    }
}

/// Rays pass through the holes when the relief is made, and when it is compared.
TEST_F(CutOut, ReliefKeepsGapsAndShowsTheBackgroundThroughThem) {
    for (const bool with_wall : {false, true}) {
        ASSERT_NO_FATAL_FAILURE(bake_fence(with_wall, true));
        const Truth truth = Truth::build(mesh_, pack::place(pack_, kiosk_.prop).prop_from_artifact).value();
        const std::vector<pack::ReliefOutline> outlines = pack::reliefs_of(pack_).value();
        ASSERT_FALSE(outlines.empty());
        const auto relief =
            std::make_shared<const relief::BlockRelief>(pack::relief_of(pack_, outlines.back()).value());
        auto technique =
            make_pack_relief(kiosk_, pack_, relief, {}, {render::finest_samples}, "relief").value();
        const auto poses = draw_poses(kiosk_.settings, kiosk_.prop, 6, 3);
        ASSERT_TRUE(poses);
        for (const BenchPose& pose : *poses) {
            const TruthPicture cast = ray_cast(truth, pose);
            const PictureError error = DrawnNear::error_of(*technique, pose, cast);
            EXPECT_GT(error.truth_pixels, 30);
            EXPECT_TRUE(error.silhouette_percent <= 0.6 || error.outline_shift_px <= 0.2)
                << error.silhouette_percent << " % " << error.outline_shift_px << " px";
            EXPECT_LT(error.geometric_mean_mm, 0.5); // the boards are 20 mm apart
            // A corner's colour extends over a cell, also across the edge of a picket: up to 16.1 here; green
            // would be 100 and more.
            EXPECT_LT(error.sixteen_rays.rmse, 20.0);
        }
    }
}

TEST_F(CutOut, ArtifactWithoutMaskHasNoCutTexels) {
    mesh_ = fence(true);
    mesh_->materials[0].alpha_mask = false;
    bake::BakeOptions options;
    options.size = 128;
    options.unlit = true;
    options.relief = false;
    options.measuring = 0.05;
    const Result<pack::Pack> pack = bake::bake(*mesh_, options);
    ASSERT_TRUE(pack);
    for (const image::Image8& texture : pack->textures) {
        EXPECT_FALSE(image::has_cut_texels(texture));
    }
}

} // namespace
} // namespace frustumscreen::bench
