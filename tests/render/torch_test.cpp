// Torches that light a world of meshes and reliefs, against rays: pixels that no torch touches are the same bytes, lit ones have the
// intensity of their distance from it, and shadows end within a pixel of the torch's own picture.

#include "tests/render/counted_new.h"
#include "tests/render/keep_picture.h"
#include "tests/render/torch_compare.h"

#include <string>

namespace frustumscreen::synthetic {
namespace {

struct Lit {
    std::string name;
    std::vector<WorldObject> objects;
    std::vector<Way> chosen;
    geometry::PropShape prop = geometry::make_frustum({});
    geometry::Lens lens{};
    std::size_t torches = 1;
    int samples = 1;
    int poses = 16;
    std::size_t min_lit = 300; ///< pixels a pose
};

image::Image8 picture_of(Interlocked& world, const TestTable& table,
                         std::span<const scene::PlacedTorch> torches) {
    scene::PlanView view = table.view();
    view.torches = torches;
    return world.picture(view);
}

/// Each of several samples a pixel, and each triangle whose corners alone a lens bends, shows places beside the pixel's middle.
Tolerance tolerance_of(const Lit& lit) {
    const bool all_meshes = std::ranges::count(lit.chosen, Way::Mesh) == std::ssize(lit.chosen);
    return all_meshes && lit.samples == 1 && lit.lens.is_plain() ? of_mesh : of_relief;
}

void check(const Lit& lit) {
    Interlocked world(lit.prop, lit.objects, lit.samples, lit.lens, 256, true);
    world.choose(lit.chosen);
    for (scene::Part& part : world.parts) {
        part.level.light = glm::vec3(base_light);
    }
    TestTable table = table_of(lit.lens);
    table.prop = lit.prop;
    std::mt19937 random(48);
    Counts counts;
    for (int pose = 0; pose < lit.poses; ++pose) {
        (table.*(lit.prop.faces.size() == 6 ? &TestTable::hold : &TestTable::shuffle))(random);
        std::vector<scene::PlacedTorch> torches;
        for (std::size_t k = 0; k < lit.torches; ++k) {
            torches.push_back(seeded_torch(table, random, pose + 7 * static_cast<int>(k)));
        }
        const image::Image8 without = picture_of(world, table, {});
        const image::Image8 with = picture_of(world, table, torches);
        Compared(world, table, torches, tolerance_of(lit)).count(without, with, counts);
        keep_picture(with, "TORCH_PICTURES", lit.name + "_" + std::to_string(pose));
    }
    const std::size_t pixels = counts.lit + counts.dark;
    std::printf(
        "%s: %zu lit, %zu dark, %zu of them in a shadow; excused: %zu at an outline, %zu at an edge of the "
        "light; %zu wrong, by up to %.2f codes more than allowed\n",
        lit.name.c_str(), counts.lit, counts.dark, counts.shadow, counts.outline, counts.edge, counts.wrong,
        counts.worst);
    const auto poses = static_cast<std::size_t>(lit.poses);
    EXPECT_GT(counts.lit, lit.min_lit * poses);
    EXPECT_GT(counts.dark, lit.min_lit * poses);
    EXPECT_GT(counts.shadow, lit.min_lit / 6 * poses);
    const bool exact = tolerance_of(lit).eye_px < 1.0;
    // Where two surfaces meet within a pixel, the light's pass may take the other one.
    EXPECT_LE(counts.wrong, pixels / (exact ? 20000 : 2000)) << "by up to " << counts.worst << " codes";
    EXPECT_LT(counts.outline, pixels / 20);
    EXPECT_LT(counts.edge, pixels / (exact ? 50 : 12));
}

TEST(Torch, MatchesRaysOnMeshes) {
    check({.name = "mesh", .objects = as_one(ball_and_post()), .chosen = {Way::Mesh}});
}

TEST(Torch, MatchesRaysOnARasterizedRelief) {
    check({.name = "raster", .objects = as_one(ball_and_post()), .chosen = {Way::RasterizedRelief}});
    check({.name = "raster_lens",
           .objects = as_one(ball_and_post()),
           .chosen = {Way::RasterizedRelief},
           .lens = lenses[3]});
}

TEST(Torch, MatchesRaysOnAGpuRelief) {
    check({.name = "gpu", .objects = as_one(ball_and_post()), .chosen = {Way::DrawnRelief}});
    check({.name = "gpu_lens",
           .objects = as_one(ball_and_post()),
           .chosen = {Way::DrawnRelief},
           .lens = lenses[3]});
}

TEST(Torch, CellsCastShadowsOnEachOther) {
    check({.name = "cells_m", .objects = ball_and_post(), .chosen = {Way::Mesh, Way::Mesh, Way::Mesh}});
    check({.name = "cells_mr",
           .objects = ball_and_post(),
           .chosen = {Way::RasterizedRelief, Way::Mesh, Way::RasterizedRelief}});
    check({.name = "cells_rgm",
           .objects = ball_and_post(),
           .chosen = {Way::Mesh, Way::RasterizedRelief, Way::DrawnRelief}});
}

TEST(Torch, MatchesRaysInsideACrate) {
    check({.name = "crate_m", .objects = box_in_crate(), .chosen = {Way::Mesh, Way::Mesh}});
    check({.name = "crate_r",
           .objects = box_in_crate(),
           .chosen = {Way::RasterizedRelief, Way::RasterizedRelief}});
}

TEST(Torch, SeveralMatchRays) {
    check({.name = "three",
           .objects = ball_and_post(),
           .chosen = {Way::Mesh, Way::Mesh, Way::Mesh},
           .torches = 3});
    check({.name = "four_r",
           .objects = as_one(ball_and_post()),
           .chosen = {Way::RasterizedRelief},
           .torches = 4,
           .poses = 8});
}

TEST(Torch, MatchesRaysOnAHeldCubeBehindADistortingLens) {
    Lit cube{.name = "cube_m",
             .objects = ball_in_ring(), // of small triangles: a lens bends their corners alone
             .chosen = {Way::Mesh, Way::Mesh},
             .prop = geometry::make_cube(0.16),
             .lens = lenses[2],
             .min_lit = 60};
    check(cube);
    cube.name = "cube_mr";
    cube.chosen = {Way::Mesh, Way::RasterizedRelief};
    check(cube);
}

TEST(Torch, SeveralSamplesAPixelAreRightAwayFromEdges) {
    check({.name = "samples",
           .objects = ball_and_post(),
           .chosen = {Way::Mesh, Way::Mesh, Way::Mesh},
           .samples = 4});
}

/// Objects at one pose.
struct Still {
    Interlocked world;
    TestTable table = table_of({});

    explicit Still(Way way, unsigned seed = 5, const std::vector<WorldObject>& objects = ball_and_post())
        : world(geometry::make_frustum({}), objects, 1, {}, 160, true) {
        world.choose(std::vector(objects.size(), way));
        for (scene::Part& part : world.parts) {
            part.level.light = glm::vec3(base_light);
        }
        std::mt19937 random(seed);
        table.shuffle(random);
    }
    [[nodiscard]] glm::dvec3 middle() const { return table.table_from_prop.point(table.prop.middle); }
    [[nodiscard]] image::Image8 lit_by(std::span<const scene::PlacedTorch> torches) {
        return picture_of(world, table, torches);
    }
};

torch::Beam wide_beam() {
    torch::Beam beam;
    beam.opening_rad = glm::radians(60.0);
    beam.attenuation = torch::Attenuation::None;
    return beam;
}

/// An eye at the torch sees no shadow.
TEST(Torch, AtTheEyeLightsAllThatTheEyeSees) {
    for (const Way way : ways) {
        Still still(way);
        const std::array torches{torch_of(looking(still.table.eye_m, still.middle()), wide_beam())};
        const image::Image8 without = still.lit_by({});
        const image::Image8 with = still.lit_by(torches);
        std::size_t seen = 0;
        std::size_t dark = 0;
        for (std::size_t k = 0; k < with.texels.size(); ++k) {
            const bool shown = without.texels[k] != glm::u8vec4(0, 0, 0, 255);
            seen += shown ? 1U : 0U;
            dark += shown && with.texels[k] == without.texels[k] ? 1U : 0U;
        }
        EXPECT_GT(seen, 1500U);
        EXPECT_LE(dark, way == Way::Mesh ? seen / 500 : seen / 50) << static_cast<int>(way) << " of " << seen;
    }
}

TEST(Torch, ChangesNothingWithoutLightOrAValidPose) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Way way : ways) {
        Still still(way);
        const image::Image8 without = still.lit_by({});
        const glm::dvec3 middle = still.middle();
        const glm::dvec3 aside = middle + glm::dvec3(0.0, -0.4, 0.1);
        std::vector<std::pair<std::string, scene::PlacedTorch>> none{
            {"looks away", torch_of(looking(aside, 2.0 * aside - middle), wide_beam())},
            {"is far away", torch_of(looking(middle + glm::dvec3(0.0, 0.0, 1000.0), middle), torch::Beam{})},
            {"is off", torch_of(looking(aside, middle), wide_beam())},
            {"has no content", torch_of(looking(aside, middle), wide_beam())},
            {"is nowhere", torch_of({glm::dquat(1.0, 0.0, 0.0, 0.0), glm::dvec3(nan)}, wide_beam())},
            {"has no direction", torch_of({glm::dquat(0.0, 0.0, 0.0, 0.0), aside}, wide_beam())},
            {"points nowhere", torch_of({glm::dquat(nan, 0.0, 0.0, 1.0), aside}, wide_beam())}};
        none[2].second.brightness = 0.0F;
        none[3].second.stage_count = 0;
        for (const auto& [name, torch] : none) {
            EXPECT_EQ(still.lit_by(std::span(&torch, 1)).texels, without.texels)
                << name << ' ' << static_cast<int>(way);
        }
    }
}

/// Makes every mesh one with cut-outs, of which none is cut out.
void make_cut_outs(Still& still) {
    scene::RenderNeeds needs = needs_with_reliefs(1, still.table.projector);
    for (scene::ShaderKey key : needs_with_reliefs(1, still.table.projector).draws) {
        key.cut_out = key.pass == scene::ShaderKey::Pass::Surface && !key.blocks;
        needs.draws.insert(key);
    }
    EXPECT_TRUE(still.world.renderer->prepare(
        scene::with_torch(scene::with_cells(std::move(needs)), torch::parts_of(torch::white().stages, {}))));
    for (scene::Part& part : still.world.parts) {
        part.level.drawable.material.cut_out = true;
    }
}

struct Walls {
    Way way;
    bool cut_outs = false;
};

/// In the plate, in the ball, in the post: at most what is in the beam is lit, and nothing through walls.
TEST(Torch, InsideAnObjectLightsNothingBesideItsBeam) {
    for (const auto& [way, cut_outs] :
         {Walls{Way::Mesh}, Walls{Way::Mesh, true}, Walls{Way::DrawnRelief}, Walls{Way::RasterizedRelief}}) {
        Still still(way);
        if (cut_outs) {
            make_cut_outs(still);
        }
        const image::Image8 without = still.lit_by({});
        const glm::dvec3 eye = still.table.table_from_prop.inverse().point(still.table.eye_m);
        std::size_t unchanged = 0;
        std::size_t changed = 0;
        std::size_t through_walls = 0;
        for (std::size_t part = 0; part < 3; ++part) {
            const scene::PlacedLevel& level = still.world.parts[part].level;
            const geometry::Box placed = level.placed_box();
            const glm::dvec3 inside(level.prop_from_placed *
                                    glm::dvec4(0.5 * (placed.low + placed.high), 1.0));
            const glm::dvec3 from = still.table.table_from_prop.point(inside);
            for (const glm::dvec3& towards : {glm::dvec3(0.3, 0.2, 1.0), glm::dvec3(-1.0, 0.1, 0.2)}) {
                const std::array torches{torch_of(looking(from, from + towards), wide_beam())};
                const image::Image8 with = still.lit_by(torches);
                const TorchTruth truth(still.world, torches[0], still.table);
                for (int y = 0; y < with.height; ++y) {
                    for (int x = 0; x < with.width; ++x) {
                        const glm::dvec2 pixel(x + 0.5, y + 0.5);
                        if (without.at(x, y) == with.at(x, y)) {
                            ++unchanged;
                            continue;
                        }
                        bool may_be_lit = false;
                        bool is_lit = false;
                        for (int k = 0; k < 9; ++k) {
                            const SeenPart place =
                                still.world.seen(still.table, pixel + glm::dvec2(k % 3 - 1, k / 3 - 1));
                            may_be_lit = may_be_lit || (place.part >= 0 && truth.in_beam(place.point));
                            is_lit = is_lit || (place.part >= 0 && truth.lights(place, eye));
                        }
                        ++changed;
                        through_walls += is_lit ? 0U : 1U;
                        EXPECT_TRUE(may_be_lit) << x << ' ' << y << ' ' << static_cast<int>(way);
                    }
                }
            }
        }
        EXPECT_GT(unchanged, 300'000U);
        std::printf("%d%s: %zu lit, %zu of them through walls\n", static_cast<int>(way),
                    cut_outs ? " with cut-outs" : "", changed, through_walls);
        EXPECT_LE(through_walls, 10U) << "of " << unchanged + changed;
    }
}

/// There it is in the object's box, and not in the object.
TEST(Torch, MatchesRaysBetweenTheWallsOfACrate) {
    for (const auto& [way, cut_outs] :
         {Walls{Way::Mesh}, Walls{Way::Mesh, true}, Walls{Way::DrawnRelief}, Walls{Way::RasterizedRelief}}) {
        Still still(way, 5, box_in_crate());
        if (cut_outs) {
            make_cut_outs(still);
        }
        const scene::PlacedLevel& crate = still.world.parts.front().level;
        const geometry::Box placed = crate.placed_box();
        std::mt19937 random(48);
        Counts counts;
        for (int pose = 0; pose < 8; ++pose) {
            still.table.shuffle(random);
            const glm::dvec3 place = placed.low + glm::dvec3(0.2, 0.5, 0.7) * (placed.high - placed.low);
            const glm::dvec3 from = still.table.table_from_prop.point(
                glm::dvec3(crate.prop_from_placed * glm::dvec4(place, 1.0)));
            const glm::dvec3 towards = still.table.table_from_prop.direction({1.0, 0.1 * pose - 0.4, -0.8});
            const std::array torches{torch_of(looking(from, from + towards), wide_beam())};
            Compared(still.world, still.table, torches,
                     cut_outs           ? of_cut_outs
                     : way == Way::Mesh ? of_mesh
                                        : of_relief)
                .count(still.lit_by({}), still.lit_by(torches), counts);
        }
        std::printf("crate %d%s: %zu lit, %zu dark, excused %zu, %zu; %zu wrong\n", static_cast<int>(way),
                    cut_outs ? " with cut-outs" : "", counts.lit, counts.dark, counts.outline, counts.edge,
                    counts.wrong);
        EXPECT_GT(counts.lit, 2000U);
        EXPECT_LE(counts.wrong, (counts.lit + counts.dark) / (way == Way::Mesh ? 20000 : 2000));
    }
}

/// The processor lights a relief with plain light, the GPU with any other content; here the second stage adds nothing.
TEST(Torch, LightsAReliefAlikeFromProcessorAndGpu) {
    Still still(Way::RasterizedRelief);
    EXPECT_TRUE(still.world.renderer->prepare(
        scene::with_torches(scene::with_cells(needs_with_reliefs(1, still.table.projector)))));
    std::mt19937 random(48);
    std::size_t lit = 0;
    std::size_t others = 0;
    for (int pose = 0; pose < 8; ++pose) {
        still.table.shuffle(random);
        scene::PlacedTorch torch = seeded_torch(still.table, random, pose);
        const image::Image8 without = still.lit_by({});
        const image::Image8 plain = still.lit_by(std::span(&torch, 1));
        torch.stages[1] = torch.stages[0];
        torch.stages_at[1].opacity = 0.0F;
        torch.stage_count = 2;
        const image::Image8 stages = still.lit_by(std::span(&torch, 1));
        for (std::size_t k = 0; k < plain.texels.size(); ++k) {
            lit += stages.texels[k] != without.texels[k] ? 1U : 0U;
            others += farthest_channel(plain.texels[k], stages.texels[k]) > 1 ? 1U : 0U;
        }
    }
    EXPECT_GT(lit, 5000U);
    EXPECT_LE(others, lit / 2000) << "of " << lit;
}

TEST(Torch, AFrameAllocatesNothing) {
    if (!allocations_are_counted) {
        GTEST_SKIP() << "allocations are not counted under a sanitizer";
    }
    Still still(Way::Mesh);
    still.world.choose(std::array{Way::RasterizedRelief, Way::Mesh, Way::RasterizedRelief});
    std::mt19937 random(5);
    std::vector<std::pair<TestTable, std::vector<scene::PlacedTorch>>> frames;
    for (int k = 0; k < 10; ++k) {
        still.table.shuffle(random);
        frames.emplace_back(still.table, std::vector<scene::PlacedTorch>());
        for (int torch = 0; torch < 4; ++torch) {
            frames.back().second.push_back(seeded_torch(still.table, random, k + torch));
        }
    }
    long counted = 0;
    for (int k = 0; k < 40; ++k) { // the first rounds reserve memory for the fullest view
        const auto& [table, torches] = frames[static_cast<std::size_t>(k) % frames.size()];
        scene::PlanView view = table.view();
        view.torches = torches;
        const long before = allocations_so_far();
        scene::plan_frame(still.world.prop, still.world.parts, view, still.world.plan);
        static_cast<void>(still.world.renderer->draw(
            still.world.plan, {still.world.display->framebuffer(), still.world.display->buffer_age()},
            render::Redraw::Everything));
        counted += k < 30 ? 0 : allocations_so_far() - before;
    }
    EXPECT_EQ(counted, 0);
}

} // namespace
} // namespace frustumscreen::synthetic
