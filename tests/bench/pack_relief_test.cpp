// A pack's own reliefs drawn by the bench, against the ray cast of the baked mesh.

#include "app/bench/measures/comparison.h"
#include "app/bench/techniques/relief_raster.h"
#include "app/pack/pack_relief.h"
#include "assets_baked/bake/bake.h"
#include "tests/bench/drawn_near.h"
#include "tests/bench/ring.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

namespace frustumscreen::bench {
namespace {

class PackRelief : public DrawnNear {
protected:
    static std::shared_ptr<bake::SourceMesh> upright_ring() {
        std::shared_ptr<bake::SourceMesh> mesh = ring();
        mesh->default_up = 'z';
        return mesh;
    }
    static pack::Pack baked(int size, bool unlit) {
        bake::BakeOptions options;
        options.size = size;
        options.unlit = unlit;
        options.measuring = 0.05;
        return bake::bake(*upright_ring(), options).value();
    }
    static const pack::Pack& ring_pack() {
        static const pack::Pack pack = baked(192, true);
        return pack;
    }

    const std::shared_ptr<bake::SourceMesh> mesh_ = upright_ring();
    const pack::Pack& pack_ = ring_pack();
};

TEST_F(PackRelief, HasANamedRowForEachReliefOnCpuAndGpu) {
    Result<Comparison> opened = open_comparison({"near", kiosk_.settings}, pack_, {}, mesh_, {{}, 4, 3});
    ASSERT_TRUE(opened) << opened.error().message;
    ASSERT_TRUE(opened->set->add_reliefs(pack_, {}));
    ASSERT_TRUE(opened->set->add_reliefs_on_gpu(pack_, {}));
    ASSERT_TRUE(opened->set->measure_errors(opened->truth, opened->poses, 0, [](double) {}));
    std::vector<TechniqueResult> reliefs;
    std::vector<TechniqueResult> on_gpu;
    for (const TechniqueResult& result : opened->set->results()) {
        if (result.kind == TechniqueKind::PackRelief) {
            reliefs.push_back(result);
        }
        if (result.kind == TechniqueKind::ReliefGpu) {
            on_gpu.push_back(result);
        }
    }
    ASSERT_EQ(reliefs.size(), 2U);
    ASSERT_EQ(on_gpu.size(), 2U);
    EXPECT_EQ(reliefs[0].name, "relief96");
    EXPECT_EQ(reliefs[1].name, "relief192");
    const std::vector<pack::ReliefOutline> outlines = pack::reliefs_of(pack_).value();
    for (std::size_t k = 0; k < reliefs.size(); ++k) {
        EXPECT_EQ(reliefs[k].triangles, outlines[k].blocks);
        EXPECT_EQ(reliefs[k].samples, pack_.samples);
        EXPECT_GT(reliefs[k].error.mean.truth_pixels, 300);
        EXPECT_GT(reliefs[k].error.mean.geometric_mean_mm, 0.0);
        const double texel_mm = 1e3 * pack::place(pack_, kiosk_.prop).metres_per_box / outlines[k].texels;
        EXPECT_LT(reliefs[k].error.mean.geometric_mean_mm, 0.5 * texel_mm);
        EXPECT_LT(reliefs[k].error.worst.outline_shift_px, 1.0);
        EXPECT_FALSE(reliefs[k].drawn_as.empty());
        EXPECT_EQ(on_gpu[k].name, reliefs[k].name + "-gpu");
        EXPECT_EQ(on_gpu[k].triangles, reliefs[k].triangles);
        EXPECT_NEAR(on_gpu[k].error.mean.geometric_mean_mm, reliefs[k].error.mean.geometric_mean_mm,
                    0.1 * texel_mm);
        EXPECT_LT(on_gpu[k].error.worst.drawn_shift_px, 0.1);
        EXPECT_EQ(reliefs[k].bytes, relief::bytes_of(pack::relief_of(pack_, outlines[k]).value()));
        for (const std::optional<scene::ErrorEstimate>& estimate : reliefs[k].estimates) {
            EXPECT_TRUE(estimate.has_value());
        }
    }
    EXPECT_LT(reliefs[1].error.mean.geometric_mean_mm, reliefs[0].error.mean.geometric_mean_mm);
    EXPECT_LT(reliefs[1].error.mean.sixteen_rays.rmse, reliefs[0].error.mean.sixteen_rays.rmse);
}

/// With and without light baked into the colours: light that falls off towards an outline must not count as a
/// shift.
TEST_F(PackRelief, LevelsAndReliefsAreDrawnWhereTheirSurfacesAre) {
    const pack::Pack with_light = baked(96, false);
    for (const pack::Pack* const pack : std::array<const pack::Pack*, 2>{&pack_, &with_light}) {
        const std::vector<std::uint32_t> levels{pack->default_level};
        Result<Comparison> opened =
            open_comparison({"near", kiosk_.settings}, *pack, levels, mesh_, {{}, 3, 3});
        ASSERT_TRUE(opened) << opened.error().message;
        ASSERT_TRUE(opened->set->add_reliefs(*pack, {}));
        ASSERT_TRUE(opened->set->measure_errors(opened->truth, opened->poses, 0, [](double) {}));
        std::size_t judged = 0;
        for (const TechniqueResult& result : opened->set->results()) {
            if (result.kind == TechniqueKind::Floor) {
                continue;
            }
            ++judged;
            std::printf("%s, %s: worst pose %.4f px\n", result.name.c_str(), pack->unlit ? "unlit" : "lit",
                        result.error.worst.drawn_shift_px);
            EXPECT_FALSE(result.drawn_as.empty());
            EXPECT_GT(result.error.worst.drawn_shift_px, 0.0) << result.name;
            EXPECT_LT(result.error.worst.drawn_shift_px, 0.05) << result.name;
        }
        EXPECT_EQ(judged, 1 + pack::reliefs_of(*pack).value().size());
    }
}

/// Reliefs baked by the bench equal those in the pack.
TEST_F(PackRelief, TheBenchBakesTheReliefsThatThePackHas) {
    const std::vector<pack::ReliefOutline> outlines = pack::reliefs_of(pack_).value();
    ASSERT_FALSE(outlines.empty());
    for (const pack::ReliefOutline& outline : outlines) {
        const relief::BlockRelief packed = pack::relief_of(pack_, outline).value();
        const relief::BlockRelief baked = blocks_of_pack(pack_, static_cast<int>(outline.texels));
        ASSERT_EQ(baked.blocks.size(), packed.blocks.size());
        EXPECT_EQ(baked.corner_codes, packed.corner_codes);
        EXPECT_EQ(baked.covers, packed.covers);
    }
}

} // namespace
} // namespace frustumscreen::bench
