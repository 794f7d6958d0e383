// Windows on the table, against rays: each pixel shows the surface that the eye's ray meets behind the window, the
// prop's pixels are the same bytes as without windows, and all others stay dark.

#include "tests/render/keep_picture.h"
#include "tests/render/stereo_rig.h"
#include "tests/render/window_rig.h"

#include <string>

namespace frustumscreen::synthetic {
namespace {

/// The part of a pixel by its colour: 0 red, 1 green, 2 blue; -1: none.
int part_of(const glm::u8vec4& code) {
    const int brightest = std::max({code.r, code.g, code.b});
    return brightest < 128 ? -1 : brightest == code.r ? 0 : brightest == code.g ? 1 : 2;
}

struct Seen {
    std::string name;
    std::vector<WorldObject> objects;
    std::vector<Way> chosen;
    geometry::Lens lens{};
    int samples = 1;
    std::size_t windows = 2;
    int poses = 9;
};

WindowTolerance tolerance_of(const Seen& seen) {
    const bool meshes = std::ranges::count(seen.chosen, Way::Mesh) == std::ssize(seen.chosen);
    const bool exact = seen.samples == 1 && seen.lens.is_plain();
    return {.outline_px = meshes && exact ? 1.0 / 32.0 : 1.5,
            .edge_px = exact               ? 1.0 / 32.0
                       : seen.samples == 1 ? 0.25
                                           : 1.0};
}

void check(const Seen& seen) {
    WindowRig rig(seen.objects, seen.chosen, seen.samples, seen.lens);
    std::mt19937 random(49);
    WindowCounts counts;
    for (int pose = 0; pose < seen.poses; ++pose) {
        rig.table.shuffle(random);
        rig.pin_some(random, seen.windows);
        if (pose % 3 != 0) { // another eye than the one that pinned, and the prop elsewhere
            rig.table.shuffle(random);
        }
        const image::Image8 without = rig.world.picture(rig.view({}));
        const image::Image8 with = rig.picture();
        keep_picture(with, "WINDOW_PICTURES", seen.name + "_" + std::to_string(pose));
        count_pixels(
            WindowTruth(rig.table, rig.pinned), tolerance_of(seen), without, with, part_of,
            [&](const glm::dvec3& from, const glm::dvec3& direction) { return rig.first(from, direction); },
            counts);
    }
    std::printf("%s: %zu pixels of windows show something, %zu nothing; %zu of the prop, %zu of the table; "
                "excused: %zu at an outline, %zu at an edge, %zu beside the prop; %zu wrong\n",
                seen.name.c_str(), counts.shown, counts.empty, counts.prop, counts.table, counts.outline,
                counts.edge, counts.cover, counts.wrong);
    const bool exact = tolerance_of(seen).outline_px < 1.0;
    EXPECT_GT(counts.shown, 100U * seen.windows * static_cast<std::size_t>(seen.poses));
    EXPECT_GT(counts.empty, 100U * seen.windows * static_cast<std::size_t>(seen.poses));
    EXPECT_GT(counts.prop, 1000U * static_cast<std::size_t>(seen.poses));
    // Where two surfaces meet within a texel, a relief may show the other one.
    EXPECT_LE(counts.wrong, exact ? 0U : counts.windows() / 2000);
    EXPECT_LT(counts.outline, counts.windows() / (exact ? 200 : 10));
    EXPECT_LT(counts.edge, counts.windows() / (exact ? 200 : 10));
    EXPECT_LT(counts.cover, counts.prop / 20);
}

TEST(Windows, MatchRaysOnMeshes) {
    check({.name = "mesh", .objects = as_one(ball_and_post()), .chosen = {Way::Mesh}});
}

TEST(Windows, MatchRaysOnARasterizedRelief) {
    check({.name = "raster", .objects = as_one(ball_and_post()), .chosen = {Way::RasterizedRelief}});
}

TEST(Windows, MatchRaysOnAGpuRelief) {
    check({.name = "gpu", .objects = as_one(ball_and_post()), .chosen = {Way::DrawnRelief}, .poses = 3});
}

TEST(Windows, MatchRaysOnCells) {
    check({.name = "cells_m", .objects = ball_and_post(), .chosen = {Way::Mesh, Way::Mesh, Way::Mesh}});
    check({.name = "cells_rrr",
           .objects = ball_and_post(),
           .chosen = {Way::RasterizedRelief, Way::RasterizedRelief, Way::RasterizedRelief}});
    check({.name = "cells_rmr",
           .objects = ball_and_post(),
           .chosen = {Way::RasterizedRelief, Way::Mesh, Way::RasterizedRelief}});
    check({.name = "cells_rgm",
           .objects = ball_and_post(),
           .chosen = {Way::Mesh, Way::RasterizedRelief, Way::DrawnRelief},
           .poses = 3});
}

TEST(Windows, MatchRaysWithFourWindows) {
    check({.name = "four_m", .objects = as_one(ball_and_post()), .chosen = {Way::Mesh}, .windows = 4});
    check({.name = "four_r",
           .objects = as_one(ball_and_post()),
           .chosen = {Way::RasterizedRelief},
           .windows = 4});
}

TEST(Windows, MatchRaysBehindADistortingLens) {
    for (const std::size_t lens : {std::size_t{1}, std::size_t{2}}) {
        check({.name = "lens_m" + std::to_string(lens),
               .objects = ball_in_ring(), // of small triangles: a lens bends their corners alone
               .chosen = {Way::Mesh, Way::Mesh},
               .lens = lenses[lens]});
        check({.name = "lens_r" + std::to_string(lens),
               .objects = ball_in_ring(),
               .chosen = {Way::RasterizedRelief, Way::RasterizedRelief},
               .lens = lenses[lens]});
    }
}

TEST(Windows, SeveralSamplesAPixelAreRightAwayFromEdges) {
    check({.name = "samples_m",
           .objects = ball_and_post(),
           .chosen = {Way::Mesh, Way::Mesh, Way::Mesh},
           .samples = 4});
    check({.name = "samples_rm",
           .objects = ball_and_post(),
           .chosen = {Way::RasterizedRelief, Way::Mesh, Way::RasterizedRelief},
           .samples = 4});
}

/// A hand-over from a mesh to a relief gives each pixel to one of them.
TEST(Windows, FadeFromOneWayToAnother) {
    WindowRig rig(as_one(ball_and_post()), std::array{Way::Mesh});
    const scene::PlacedLevel mesh = rig.world.parts[0].level;
    rig.world.choose(std::array{Way::RasterizedRelief});
    const scene::PlacedLevel relief = rig.world.parts[0].level;
    rig.pin({.middle_m = {0.15, 0.0}, .width_m = 0.075, .depth_m = 0.075});
    const image::Image8 without = rig.world.picture(rig.view({}));
    WindowCounts counts;
    for (const double share : {0.0, 0.3, 0.7, 1.0}) {
        const std::array<scene::Part, 2> fading = scene::fade(mesh, relief, share);
        scene::move_behind(rig.pinned[0].view.window_from_prop, fading, rig.pinned[0].parts);
        count_pixels(
            WindowTruth(rig.table, rig.pinned), {.outline_px = 1.5}, without, rig.picture(), part_of,
            [&](const glm::dvec3& from, const glm::dvec3& direction) { return rig.first(from, direction); },
            counts);
    }
    EXPECT_GT(counts.shown, 1000U);
    EXPECT_LE(counts.wrong, counts.windows() / 2000);
    EXPECT_LT(counts.outline, counts.shown / 5);
}

/// Even light: the light that falls onto the table, times the picture's, is the same everywhere.
TEST(Windows, HaveEvenLightEverywhere) {
    for (const Way way : {Way::Mesh, Way::RasterizedRelief}) {
        WindowRig rig(ball_and_post(), std::array{way, way, way});
        std::mt19937 random(3);
        rig.table.shuffle(random);
        rig.pin_some(random, 4);
        const scene::LightCompensation light;
        const image::Image8 with = rig.picture(light);
        const WindowTruth truth(rig.table, rig.pinned);
        std::size_t compared = 0;
        for (int y = 0; y < with.height; ++y) {
            for (int x = 0; x < with.width; ++x) {
                const glm::dvec2 pixel(x + 0.5, y + 0.5);
                const LitPlace lit = truth.at(pixel);
                const auto shown = [&](const glm::dvec2& at) {
                    const LitPlace place = truth.at(at);
                    const PropRay ray = truth.ray(lit.window, place.point);
                    return place.window == lit.window ? rig.first(ray.from, ray.direction) : -1;
                };
                if (lit.window < 0) {
                    continue;
                }
                const int part = shown(pixel);
                if (part < 0 ||
                    !truth.all_around(pixel, 2.5, [&](const glm::dvec2& at) { return shown(at) == part; })) {
                    continue;
                }
                const glm::dvec3 path = lit.point - rig.table.table_from_projector.translation;
                const double received = -path.z / std::pow(glm::length(path), 3.0);
                const double linear = light.reference / received;
                const double code = 255.0 * (1.055 * std::pow(linear, 1.0 / 2.4) - 0.055);
                EXPECT_NEAR(with.at(x, y)[part], code, 1.6) << x << ' ' << y << ' ' << static_cast<int>(way);
                ++compared;
            }
        }
        EXPECT_GT(compared, 100U);
    }
}

/// Each eye's part of the picture shows what that eye's rays meet.
TEST(Windows, AreSeenByTwoEyes) {
    for (const settings::Stereo stereo :
         {settings::Stereo::SideBySide, settings::Stereo::TopBottom, settings::Stereo::Anaglyph}) {
        StereoRig rig(scene::stereo_layout(table_of({}).projector, stereo));
        const ReferenceCast cast(rig.pack, rig.level.metres_per_box);
        for (scene::FramePlan& plan : rig.plans) {
            scene::make_window_space(plan, 2, rig.level.triangles->indices.size(), 1);
        }
        std::mt19937 random(9);
        WindowCounts counts;
        for (const scene::PlacedLevel& which : rig.part) {
            rig.shuffle(random);
            rig.table_from_head = {1.0, 0.0, 0.0, 0.0};
            const scene::Part part{which, std::nullopt};
            const auto first = [&](const glm::dvec3& from, const glm::dvec3& direction) {
                return cast.first_hit(from, direction).found ? 0 : -1;
            };
            std::vector<Pinned> pinned;
            for (const double side : {-1.0, 1.0}) {
                pinned.emplace_back(
                    rig.table, std::span(&part, 1),
                    scene::WindowPlace{.middle_m = {0.15 * side, 0.0}, .width_m = 0.07, .depth_m = 0.07});
            }
            const std::vector<scene::PlacedWindow> windows = placed(pinned);
            const std::array<glm::dvec3, 2> eyes = rig.eyes();
            const auto draw = [&](std::span<const scene::PlacedWindow> shown) {
                scene::PlanView view = rig.table.view();
                view.windows = shown;
                const std::array<scene::PlanView, 2> views = scene::views_of(rig.layout, view, eyes);
                for (std::size_t eye = 0; eye < 2; ++eye) {
                    scene::plan_frame(rig.prop, std::span(&part, 1), views[eye], rig.plans[eye]);
                    rig.plans[eye].samples = std::min(rig.plans[eye].samples, 1);
                }
                return rig.drawn_plans();
            };
            const image::Image8 without = draw({});
            const image::Image8 with = draw(windows);
            for (std::size_t eye = 0; eye < 2; ++eye) {
                const glm::bvec3& channels = rig.layout.pictures[eye].channels;
                TestTable seen = rig.table;
                seen.projector = rig.layout.pinhole;
                seen.eye_m = eyes[eye];
                count_pixels(
                    WindowTruth(seen, pinned), {.outline_px = 1.5, .edge_px = 0.25},
                    coloured(seen_by(eye, rig.layout, without), channels),
                    coloured(seen_by(eye, rig.layout, with), channels),
                    [](const glm::u8vec4& code) { return code.r + code.g + code.b > 30 ? 0 : -1; }, first,
                    counts);
            }
        }
        EXPECT_GT(counts.shown, 1000U);
        EXPECT_LE(counts.wrong, counts.windows() / 2000) << settings::name_of(stereo);
        EXPECT_LT(counts.outline + counts.edge, counts.windows() / 10);
    }
}

} // namespace
} // namespace frustumscreen::synthetic
