// The needs of a scene, against its settings and its pack.

#include "app/scene/scene_plan.h"
#include "tests/settings/steep_table.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace frustumscreen::scene {
namespace {

/// Four levels; the placement makes one box unit 0.06 m. Errors p95: 0.48, 0.24, 0.108, 0.012 mm at 120 mm.
pack::PackOutline outline() {
    pack::PackOutline pack;
    for (const auto& [triangles, p95_box] : {std::pair(1000U, 4e-3F), std::pair(2000U, 2e-3F),
                                             std::pair(8000U, 9e-4F), std::pair(30000U, 1e-4F)}) {
        pack::LevelOutline level;
        level.error = {p95_box / 3.0F, p95_box, 4.0F * p95_box, 0.0F};
        level.triangles = triangles;
        pack.levels.push_back(level);
    }
    pack.description.extremes = {{0.0, 0.0, 1.0}, {0.2, 0.2, 0.0}}; // as tall as the prop: 0.12 m
    pack.description.captions = {{"en", "A", ""}, {"de", "B", ""}};
    pack.description.samples = 4;
    pack.description.default_level = 2;
    return pack;
}

/// Adds reliefs of these texels, each with this error in box units; a small error from `good` texels on.
pack::PackOutline outline_with_reliefs(const std::vector<std::uint32_t>& texels, float error_box,
                                       std::uint32_t good = 1U << 31U) {
    pack::PackOutline pack = outline();
    std::string reliefs;
    std::vector<std::string> parts;
    for (const std::uint32_t each : texels) {
        const float p95_box = each < good ? error_box : 1e-4F;
        parts.push_back(fmt::format("relief_blocks/{}.bin", each));
        reliefs += fmt::format(
            R"({}{{"blocks":5,"bytes":9,"error":{{"mean_box":{},"p95_box":{},"max_box":{},)"
            R"("colour_rmse":0}},"part":"{}","texels":{}}})",
            reliefs.empty() ? "" : ",", p95_box / 3.0F, p95_box, 2.0F * p95_box, parts.back(), each);
    }
    pack.description.sections = {{"relief_blocks", "{\"reliefs\":[" + reliefs + "]}", parts}};
    return pack;
}

SceneRequest request(const settings::Settings& settings) {
    SceneRequest request;
    request.captions = {0, 1};
    request.visibility = visibility_of(settings);
    return request;
}

bool leaves_out(const ScenePlan& plan, CullKind cull_kind, const std::string& what) {
    return std::any_of(plan.left_out.begin(), plan.left_out.end(), [&](const LeftOut& each) {
        EXPECT_FALSE(each.why.empty());
        return each.cull_kind == cull_kind && each.what.find(what) != std::string::npos;
    });
}

bool fades(const ScenePlan& plan) {
    const std::set<ShaderKey>& draws = plan.needs.draws;
    return std::any_of(draws.begin(), draws.end(), [](const ShaderKey& key) { return key.dithered; });
}

bool has_captions(const ScenePlan& plan) {
    return plan.needs.draws.count({ShaderKey::Pass::TablePicture}) > 0;
}

TEST(ScenePlan, HeldCubeShowsSixFacesAndStandingCubeFive) {
    settings::Settings settings = settings::steep_table();
    settings.prop = settings::cube_settings();
    pack::PackOutline pack = outline();
    pack.description.prop_kind = "cube";
    const ScenePlan held = plan_scene(settings, pack, request(settings)).value();
    EXPECT_EQ(held.faces, 0b111111U);
    settings.prop.zone = settings::PropZone::Table;
    const ScenePlan standing = plan_scene(settings, pack, request(settings)).value();
    EXPECT_EQ(standing.faces, 0b011111U);
    EXPECT_TRUE(leaves_out(standing, UnseenFaces, "face -Z"));
}

TEST(ScenePlan, ReadsOnlyTheLevelOfTheTechnique) {
    const settings::Settings settings = settings::steep_table();
    SceneRequest asked = request(settings);
    for (const auto& [technique, level] :
         {std::pair("level0", 0U), std::pair("level3", 3U), std::pair("finest", 3U)}) {
        asked.technique = technique;
        const ScenePlan plan = plan_scene(settings, outline(), asked).value();
        EXPECT_EQ(plan.levels, std::vector<std::uint32_t>{level});
        EXPECT_FALSE(fades(plan));
    }
    EXPECT_TRUE(
        leaves_out(plan_scene(settings, outline(), asked).value(), UnusedLevels, "levels 0, 1 and 2"));
    asked.technique = "level4";
    EXPECT_FALSE(plan_scene(settings, outline(), asked));
    asked.technique = "auto";
    asked.live = false; // a picture from a pose file uses the pack's default
    EXPECT_EQ(plan_scene(settings, outline(), asked).value().levels, std::vector<std::uint32_t>{2U});
}

TEST(ScenePlan, ReadsOnlyTheReliefOfTheTechnique) {
    const settings::Settings settings =
        settings::steep_table(); // a pixel is 0.56 mm on the prop, the artifact 120 mm: 214 pixels
    const pack::PackOutline pack = outline_with_reliefs({48, 96, 192, 384}, 1e-4F);
    SceneRequest asked = request(settings);
    for (const auto& [technique, texels] :
         {std::pair("relief", 192U), std::pair("relief48", 48U), std::pair("relief384", 384U)}) {
        asked.technique = technique;
        const ScenePlan plan = plan_scene(settings, pack, asked).value();
        EXPECT_TRUE(plan.levels.empty());
        EXPECT_EQ(plan.exposure_level, pack.description.default_level);
        EXPECT_TRUE(leaves_out(plan, UnusedLevels, "levels 0, 1 and 3"))
            << "level 2 is read for the exposure";
        ASSERT_EQ(plan.reliefs.size(), 1U);
        EXPECT_EQ(plan.reliefs.front().texels, texels);
        EXPECT_EQ(name_of(plan.quality_levels.front()), fmt::format("relief{}", texels));
        EXPECT_TRUE(plan.needs.rasterizes);
        EXPECT_EQ(plan.needs.samples, 1) << "its samples are taken where it is cast";
        for (const ShaderKey& key : plan.needs.draws) {
            EXPECT_NE(key.pass, ShaderKey::Pass::Surface);
        }
    }
    asked.technique = "relief100";
    EXPECT_NE(plan_scene(settings, pack, asked)
                  .error()
                  .message.find("relief, relief48, relief96, relief192 and relief384"),
              std::string::npos);
    asked.technique = "relief";
    EXPECT_NE(plan_scene(settings, outline(), asked).error().message.find("bake it again"),
              std::string::npos);
    EXPECT_EQ(
        plan_scene(settings, outline_with_reliefs({16, 32}, 1e-4F), asked).value().reliefs.front().texels,
        32U)
        << "the finest, where none is fine enough";
}

TEST(ScenePlan, GpuReliefNeedsNoRasterizerAndRoomOnTheGpu) {
    const settings::Settings settings = settings::steep_table();
    const pack::PackOutline pack = outline_with_reliefs({96, 192}, 1e-4F);
    SceneRequest asked = request(settings);
    for (const std::string_view technique : {"relief-gpu", "relief192-gpu"}) {
        asked.technique = technique;
        const ScenePlan plan = plan_scene(settings, pack, asked).value();
        ASSERT_EQ(plan.quality_levels.size(), 1U);
        EXPECT_TRUE(plan.quality_levels.front().relief && plan.quality_levels.front().on_gpu);
        EXPECT_TRUE(plan.quality_levels.front().level == 192 || technique == "relief-gpu");
        EXPECT_EQ(name_of(plan.quality_levels.front()),
                  fmt::format("relief{}-gpu", plan.reliefs.front().texels));
        EXPECT_FALSE(plan.needs.rasterizes);
        EXPECT_TRUE(std::none_of(plan.needs.draws.begin(), plan.needs.draws.end(), [](const ShaderKey& key) {
            return key.pass == ShaderKey::Pass::Raster ||
                   (key.pass == ShaderKey::Pass::Surface && !key.blocks);
        }));
    }
    for (const std::string_view wrong :
         {"level0-gpu", "auto-gpu", "relief-gpu-gpu", "-gpu", "relief96-cpu"}) {
        EXPECT_FALSE(is_technique(wrong)) << wrong;
        asked.technique = wrong;
        EXPECT_FALSE(plan_scene(settings, pack, asked)) << wrong;
    }
    asked = request(settings);
    asked.live = true;
    const auto ways_on_gpu = [&] {
        const ScenePlan plan = plan_scene(settings, pack, asked).value();
        EXPECT_EQ(plan.reliefs.size(), 1U) << "both ways read the same blocks";
        return std::count_if(plan.quality_levels.begin(), plan.quality_levels.end(),
                             [](const QualityLevel& quality_level) { return quality_level.on_gpu; });
    };
    EXPECT_EQ(ways_on_gpu(), 0);
    const std::uint32_t blocks = pack::reliefs_of(pack.description).value().back().blocks;
    asked.max_blocks_on_gpu = blocks;
    EXPECT_GT(ways_on_gpu(), 0);
    asked.max_blocks_on_gpu = blocks - 1;
    EXPECT_EQ(ways_on_gpu(), 0) << "it has no room for it, and the other ways stay";
}

TEST(ScenePlan, ReadsTheReliefThatMatchesThePixelSize) {
    const settings::Settings settings = settings::steep_table();
    const ScenePlan plan =
        plan_scene(settings, outline_with_reliefs({96, 192, 384}, 1e-4F), request(settings)).value();
    ASSERT_EQ(plan.reliefs.size(), 1U);
    EXPECT_EQ(plan.reliefs.front().texels, 192U);
    EXPECT_EQ(plan.levels, (std::vector<std::uint32_t>{1U, 0U}));
    EXPECT_TRUE(plan.needs.rasterizes);
    EXPECT_TRUE(fades(plan));
    // A relief outside the tolerance is neither read nor drawn.
    const ScenePlan meshes =
        plan_scene(settings, outline_with_reliefs({96, 192, 384}, 8e-3F), request(settings)).value();
    EXPECT_TRUE(meshes.reliefs.empty());
    EXPECT_FALSE(meshes.needs.rasterizes);
    const ScenePlan finer =
        plan_scene(settings, outline_with_reliefs({96, 192, 384, 768}, 8e-3F, 384), request(settings))
            .value();
    ASSERT_EQ(finer.reliefs.size(), 1U);
    EXPECT_EQ(finer.reliefs.front().texels, 384U)
        << "the pixel's own strays too far: the next finer one is good";
    pack::PackOutline damaged = outline_with_reliefs({96}, 1e-4F);
    damaged.description.sections.front().data = "{}";
    EXPECT_FALSE(plan_scene(settings, damaged, request(settings)));
}

TEST(ScenePlan, ReadsOnlyTheLevelsThatTheGovernorMayPick) {
    const settings::Settings settings = settings::
        steep_table(); // half a pixel is 0.28 mm: level 1 is within it, off by 0.16 mm along the rays
    const ScenePlan plan = plan_scene(settings, outline(), request(settings)).value();
    EXPECT_EQ(plan.levels, (std::vector<std::uint32_t>{1U, 0U}));
    EXPECT_TRUE(fades(plan));
    EXPECT_TRUE(leaves_out(plan, UnusedLevels, "levels 2 and 3"));
    pack::PackOutline garbage = outline();
    for (pack::LevelOutline& level : garbage.levels) {
        level.error.mean_box = std::nanf("");
    }
    EXPECT_EQ(plan_scene(settings, garbage, request(settings)).value().levels.front(), 3U);
}

TEST(ScenePlan, WithoutCullKindsHoldsEverythingAndDrawsTheSame) {
    const settings::Settings settings = settings::steep_table();
    SceneRequest asked = request(settings);
    const ScenePlan lean = plan_scene(settings, outline(), asked).value();
    asked.cull_kinds = 0;
    const ScenePlan full = plan_scene(settings, outline(), asked).value();
    EXPECT_EQ(full.levels, (std::vector<std::uint32_t>{1U, 0U, 2U, 3U}));
    ASSERT_EQ(full.quality_levels.size(), lean.quality_levels.size());
    for (std::size_t k = 0; k < full.quality_levels.size(); ++k) {
        EXPECT_EQ(full.quality_levels[k].level, lean.quality_levels[k].level);
        EXPECT_EQ(full.quality_levels[k].samples, lean.quality_levels[k].samples);
    }
    EXPECT_EQ(shaders_of(full.needs).size(), 10U);
    EXPECT_EQ(full.faces, 31U);
    EXPECT_EQ(full.captions.size(), 2U);
}

TEST(ScenePlan, HasCaptionsOnlyWhereTheyCanShow) {
    settings::Settings settings = settings::steep_table();
    SceneRequest asked = request(settings);
    EXPECT_TRUE(has_captions(plan_scene(settings, outline(), asked).value()));
    asked.captions = {1};
    const ScenePlan one = plan_scene(settings, outline(), asked).value();
    EXPECT_EQ(one.captions, std::vector<std::size_t>{1U});
    EXPECT_TRUE(leaves_out(one, UnusedCaptions, "another language"));
    settings.exhibit.captions = false;
    const ScenePlan off = plan_scene(settings, outline(), asked).value();
    EXPECT_FALSE(has_captions(off));
    settings.exhibit.zone_frame = true;
    EXPECT_TRUE(has_captions(plan_scene(settings, outline(), asked).value())) << "the frame needs the pass";
    settings.exhibit.zone_frame = false;
    EXPECT_TRUE(leaves_out(off, UnusedCaptions, "typeface"));
    settings.exhibit.captions = true;
    pack::PackOutline silent = outline();
    silent.description.captions.clear();
    asked.captions.clear();
    EXPECT_FALSE(has_captions(plan_scene(settings, silent, asked).value()));
    asked.captions = {0, 1};
    asked.live = false;
    EXPECT_TRUE(plan_scene(settings, outline(), asked).value().captions.empty());
}

TEST(ScenePlan, ListsTheShadersInUse) {
    const settings::Settings settings = settings::steep_table();
    SceneRequest asked = request(settings);
    asked.technique = "level0";
    asked.captions.clear();
    using Pass = ShaderKey::Pass;
    ShaderKey even;
    even.even_light = true;
    ShaderKey fading;
    fading.dithered = true;
    const auto shaders = [&] { return shaders_of(plan_scene(settings, outline(), asked).value().needs); };
    EXPECT_EQ(shaders(), (std::set<ShaderKey>{{Pass::Outline},
                                              even,
                                              {Pass::EdgeFeather},
                                              {Pass::TileClear},
                                              {Pass::TileAverage},
                                              {Pass::TileAverageMany}}));
    asked.light = false;
    asked.samples = 1;
    EXPECT_EQ(shaders(), (std::set<ShaderKey>{{Pass::Outline}, {Pass::Surface}}));
    asked.technique = "auto";
    EXPECT_EQ(shaders(), (std::set<ShaderKey>{{Pass::Outline}, {Pass::Surface}, fading}));
}

TEST(ShaderKey, HasANameAndANumberOfItsOwn) {
    std::set<ShaderKey> keys;
    for (unsigned bits = 0; bits < 32; ++bits) {
        ShaderKey key;
        key.coloured = (bits & 16U) != 0;
        key.even_light = (bits & 1U) != 0;
        key.dithered = (bits & 2U) != 0;
        key.cut_out = (bits & 4U) != 0;
        key.places = (bits & 8U) != 0;
        keys.insert(key.places ? places_of(key) : key);
        if (!key.cut_out) {
            key.blocks = true;
            keys.insert(key.places ? places_of(key) : key);
        }
        keys.insert(raster_shader());
    }
    for (const ShaderKey::Pass pass :
         {ShaderKey::Pass::Outline, ShaderKey::Pass::TablePicture, ShaderKey::Pass::TileClear,
          ShaderKey::Pass::TileAverage, ShaderKey::Pass::TileAverageMany, ShaderKey::Pass::RasterInDepth}) {
        keys.insert({pass});
    }
    EXPECT_EQ(keys.size(), 37U); // hit points do not depend on light
    std::set<std::string> names;
    std::set<std::uint32_t> numbers;
    for (const ShaderKey& key : keys) {
        names.insert(name_of(key));
        numbers.insert(bits_of(key));
    }
    EXPECT_EQ(names.size(), keys.size());
    EXPECT_EQ(numbers.size(), keys.size());
}

TEST(ScenePlan, LeavesOutFacesThatAFixedViewerNeverSees) {
    settings::Settings settings = settings::steep_table();
    EXPECT_EQ(plan_scene(settings, outline(), request(settings)).value().faces, 31U); // the prop may be
                                                                                      // turned
    settings.eye.tracked = false;
    settings.tracker.kind = settings::TrackerKind::None;
    // Sides lean by 0.035 / 0.12. From (0, -0.55, 0.5): -Y and the top; +-X, which lean back far enough; not
    // +Y.
    EXPECT_EQ(plan_scene(settings, outline(), request(settings)).value().faces, 0b11011U);
    settings.eye.default_m = {0.0, -0.55, 0.05}; // low: -Y alone
    EXPECT_EQ(plan_scene(settings, outline(), request(settings)).value().faces, 0b01000U);
    // A projector behind the plane of -Y does not light that face.
    settings.eye.default_m = {0.0, -0.55, 0.5};
    settings.projector.table_from_projector.translation = {0.0, 2.0, 1.2};
    EXPECT_EQ(plan_scene(settings, outline(), request(settings)).value().faces & 0b01000U, 0U);
}

} // namespace
} // namespace frustumscreen::scene
