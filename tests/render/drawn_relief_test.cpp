// A relief drawn by the GPU, against rays that meet its cells and their covers, and against the rasterizer's
// picture of the same blocks.

#include "app/render/block_upload.h"
#include "assets_baked/bake/relief_scene.h"
#include "tests/render/relief_rig.h"

#include <cmath>

namespace frustumscreen::synthetic {
namespace {

/// The point of a relief that a pixel's ray meets, in the prop frame; NaN: none.
glm::dvec3 met_by_ray(const bake::ReliefScene& scene, const TestTable& table, double metres_per_box,
                      const glm::dvec2& pixel) {
    const geometry::RigidTransform prop_from_projector =
        table.table_from_prop.inverse() * table.table_from_projector;
    const glm::dvec3 ray = prop_from_projector.direction(table.projector.ray(pixel));
    const glm::dvec3 eye = table.table_from_prop.inverse().point(table.eye_m);
    geometry::PropHit lit;
    if (!geometry::intersect(table.prop, prop_from_projector.translation, ray, lit) ||
        !(table.prop.faces[static_cast<std::size_t>(lit.face)].plane.distance(eye) > 0.0)) {
        return glm::dvec3(NAN);
    }
    const glm::dvec3 direction = glm::normalize(prop_from_projector.translation + lit.t * ray - eye);
    const bake::SurfaceHit met = scene.trace(glm::vec3(eye / metres_per_box), glm::vec3(direction));
    return met.hit ? eye + metres_per_box * static_cast<double>(met.distance) * direction : glm::dvec3(NAN);
}

relief::BlockRelief without_cuts(relief::BlockRelief relief) {
    for (relief::ReliefBlock& block : relief.blocks) {
        block.cut = 0;
    }
    relief.covers.clear();
    return relief;
}

TEST(DrawnRelief, MatchesRaysAndShowsCutCellsOnlyWhereCovered) {
    std::mt19937 random(13);
    for (const geometry::Lens& lens : lenses) {
        ReliefRig rig(1, 40, rings(), lens);
        const relief::BlockRelief whole = without_cuts(*rig.relief);
        const bake::ReliefScene scene(*rig.relief);
        const bake::ReliefScene whole_scene(whole);
        TestTable table = table_of(lens);
        std::size_t both = 0;
        std::size_t one = 0;
        std::size_t beside_covers = 0;
        std::size_t far = 0;
        for (int pose = 0; pose < 3; ++pose) {
            table.shuffle(random);
            rig.one(table, rig.drawn);
            const image::ImageFloat places = rig.places();
            for (int y = 0; y < places.height; ++y) {
                for (int x = 0; x < places.width; ++x) {
                    const auto ray = [&](const bake::ReliefScene& of) {
                        return met_by_ray(of, table, rig.drawn.metres_per_box, {x + 0.5, y + 0.5});
                    };
                    const glm::dvec3 truth = ray(scene);
                    const bool is_there = !std::isnan(places.at(x, y).x);
                    one += is_there != !std::isnan(truth.x) ? 1U : 0U;
                    beside_covers += std::isnan(truth.x) && !std::isnan(ray(whole_scene).x) ? 1U : 0U;
                    if (is_there && !std::isnan(truth.x)) {
                        both += 1;
                        far += glm::distance(glm::dvec3(places.at(x, y)), truth) > 0.1e-3 ? 1U : 0U;
                    }
                }
            }
        }
        std::printf("%zu pixels, %zu in one alone, %zu beside covers, %zu off by more than .1 mm\n", both,
                    one, beside_covers, far);
        ASSERT_GT(both, 1500U);
        EXPECT_LT(one, both / 100);
        EXPECT_GT(beside_covers, 25U);
        EXPECT_LT(one, beside_covers / 2) << "cut cells show where they are not covered";
        EXPECT_LT(far, both / 25) << "what is drawn wider lies over its neighbour, .12 mm wide here";
    }
}

TEST(DrawnRelief, MatchesTheRasterizedRelief) {
    std::mt19937 random(14);
    for (const geometry::Lens& lens : lenses) {
        for (const int samples : {1, 16}) {
            ReliefRig rig(samples, 192, rings(), lens);
            TestTable table = table_of(lens);
            std::size_t lit = 0;
            std::size_t alone = 0;
            std::size_t off = 0;
            std::size_t far = 0;
            for (int pose = 0; pose < 4; ++pose) {
                table.shuffle(random);
                const image::Image8 raster = rig.one(table, rig.raster, scene::LightCompensation{});
                const image::ImageFloat met = rig.places();
                const image::Image8 drawn = rig.one(table, rig.drawn, scene::LightCompensation{});
                const image::ImageFloat places = rig.places();
                for (std::size_t k = 0; k < raster.texels.size(); ++k) {
                    const bool in_raster = !std::isnan(met.texels[k].x);
                    const bool in_drawn = !std::isnan(places.texels[k].x);
                    alone += in_raster != in_drawn ? 1U : 0U;
                    off += farthest_channel(raster.texels[k], drawn.texels[k]) > 16 ? 1U : 0U;
                    if (in_raster && in_drawn) {
                        lit += 1;
                        far += glm::distance(met.texels[k], places.texels[k]) > 0.02e-3F ? 1U : 0U;
                    }
                }
            }
            std::printf(
                "%d samples: %zu pixels, %zu in one alone, %zu off by more than 16 codes, %zu by .02 mm\n",
                samples, lit, alone, off, far);
            ASSERT_GT(lit, 2000U);
            EXPECT_LE(alone, lit / 200);
            EXPECT_LE(off,
                      samples == 1 ? lit / 100 : lit / 15); // the rasterizer's samples are at other places in
                                                            // a pixel
            EXPECT_LE(far, lit / 50);
        }
    }
}

TEST(DrawnRelief, FadesPixelByPixelFromTheRasterizedRelief) {
    ReliefRig rig(1);
    rig.drawn.light = glm::vec3(0.5F); // otherwise the two can hardly be told apart
    TestTable table(320, 200);
    std::mt19937 random(15);
    table.shuffle(random);
    const image::Image8 raster = rig.one(table, rig.raster, scene::LightCompensation{});
    const image::Image8 drawn = rig.one(table, rig.drawn, scene::LightCompensation{});
    for (const double share : {0.25, 0.5, 0.75}) {
        const image::Image8 middle = rig.fading(table, rig.raster, rig.drawn, share);
        std::size_t differing = 0;
        std::size_t arrived = 0;
        for (std::size_t k = 0; k < middle.texels.size(); ++k) {
            const bool is_to = farthest_channel(middle.texels[k], drawn.texels[k]) <= 1;
            ASSERT_TRUE(is_to || farthest_channel(middle.texels[k], raster.texels[k]) <= 1) << k;
            const bool differs = farthest_channel(raster.texels[k], drawn.texels[k]) > 2;
            differing += differs ? 1U : 0U;
            arrived += differs && is_to ? 1U : 0U;
        }
        ASSERT_GT(differing, 1000U);
        EXPECT_NEAR(static_cast<double>(arrived) / static_cast<double>(differing), share, 0.06);
    }
}

TEST(DrawnRelief, UsesThePlannedMemoryAndFreesIt) {
    ReliefRig rig(1);
    render::GpuStore& store = rig.renderer->store();
    const std::uint64_t before = store.bytes();
    EXPECT_EQ(store.bytes(rig.raster.drawable), 0U);
    const scene::Drawable drawable = store.upload(rig.relief).value();
    EXPECT_EQ(store.bytes(drawable), render::gpu_bytes(*rig.relief));
    EXPECT_GE(store.bytes(drawable), rig.relief->blocks.size() * 372 + rig.relief->covers.size() * 8);
    EXPECT_EQ(store.bytes(), before + store.bytes(drawable));
    const GLuint numbers = store.find_blocks(drawable.mesh)->numbers.get();
    store.release(drawable);
    EXPECT_EQ(store.bytes(), before);
    EXPECT_EQ(store.find_relief(drawable.mesh), nullptr);
    EXPECT_FALSE(glIsTexture(numbers) == GL_TRUE);
}

TEST(DrawnRelief, UploadInPiecesGivesTheSamePicture) {
    ReliefRig rig(1);
    const TestTable table(320, 200);
    const image::Image8 whole = rig.one(table, rig.drawn);
    scene::LevelData data;
    data.relief = rig.relief;
    data.on_gpu = true;
    render::LevelUpload upload(std::move(data));
    int pieces = 0;
    while (!upload.done()) {
        ASSERT_TRUE(upload.go_on(1000));
        pieces += 1;
    }
    EXPECT_GT(pieces, 5);
    scene::PlacedLevel other = rig.drawn;
    other.drawable = rig.renderer->store().keep(std::move(upload));
    EXPECT_EQ(rig.one(table, other).texels, whole.texels);
}

TEST(DrawnRelief, FailedUploadIsReportedAndChangesNothing) {
    ReliefRig rig(1);
    const Result<render::BlockSheet> sheet = render::sheet_of(*rig.relief, 64);
    ASSERT_FALSE(sheet);
    EXPECT_NE(sheet.error().message.find("this driver allows 64"), std::string::npos)
        << sheet.error().message;
    EXPECT_EQ(sheet.error().message.find('\n'), std::string::npos);
    const std::uint64_t before = rig.renderer->store().bytes();
    glEnable(GL_TEXTURE_2D); // ES has no such state: the error stands for one of memory
    const Result<scene::Drawable> refused = rig.renderer->store().upload(rig.relief);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().id, "render.no_room_for_relief") << refused.error().message;
    EXPECT_EQ(rig.renderer->store().bytes(), before);
    EXPECT_GT(lit_pixels(rig.one(TestTable(320, 200), rig.raster)), 1000U);
    EXPECT_GT(lit_pixels(rig.one(TestTable(320, 200), rig.drawn)), 1000U);
}

} // namespace
} // namespace frustumscreen::synthetic
