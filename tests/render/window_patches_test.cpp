// Windows drawn by their patches, against rays and against the same windows drawn by geometry.

#include "app/ldi/point_maker.h"
#include "app/scene/window_patches.h"
#include "tests/render/counted_new.h"
#include "tests/render/keep_picture.h"
#include "tests/render/window_rig.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace frustumscreen::synthetic {
namespace {

int part_of_code(const glm::u8vec4& code) {
    const int brightest = std::max({code.r, code.g, code.b});
    return brightest < 128 ? -1 : brightest == code.r ? 0 : brightest == code.g ? 1 : 2;
}

/// All patches of a pinned window, each part in red, green or blue.
struct Patched {
    std::array<std::shared_ptr<const ldi::PointPatch>, ldi::patch_count> made;
    scene::WindowPatches patches;
};

std::vector<ldi::TriangleWorld> worlds_of(const Pinned& pinned, geometry::Box& box) {
    std::vector<ldi::TriangleWorld> worlds;
    for (std::size_t part = 0; part < pinned.parts.size(); ++part) {
        const scene::PlacedLevel& level = pinned.parts[part].level;
        ldi::TriangleWorld& world = worlds.emplace_back();
        world.indices = level.triangles->indices;
        for (const glm::vec3& position : level.triangles->positions) {
            const glm::dvec3 at(level.prop_from_box() * glm::dvec4(position, 1.0));
            const bool first = worlds.size() == 1 && world.positions.empty();
            box =
                first ? geometry::Box{at, at} : geometry::Box{glm::min(box.low, at), glm::max(box.high, at)};
            world.positions.emplace_back(at);
        }
        glm::u8vec4 colour(0, 0, 0, 255);
        colour[static_cast<int>(part)] = 255;
        world.colours.assign(world.positions.size(), colour);
    }
    return worlds;
}

Patched patched(const WindowRig& rig, const Pinned& pinned, int samples) {
    const geometry::RigidTransform& from_window = pinned.view.table_from_window;
    const glm::dvec2 half_m(pinned.view.surface.faces.front().corners[2]);
    const double pixel_m =
        glm::distance(rig.table.table_from_projector.translation, from_window.translation) /
        rig.table.projector.fx;
    const double per_m = (samples > 1 ? 2.0 : 1.0) / pixel_m;
    const ldi::Hemisphere hemisphere(glm::distance(rig.table.eye_m, from_window.translation));
    Patched result{.made = {}, .patches = {.hemisphere = hemisphere, .box = {}, .samples = samples}};
    std::vector<ldi::TriangleWorld> worlds = worlds_of(pinned, result.patches.box);
    ldi::PointMaker maker(std::move(worlds), hemisphere,
                          {.half_extent_m = half_m,
                           .width = static_cast<int>(std::lround(2.0 * half_m.x * per_m)),
                           .height = static_cast<int>(std::lround(2.0 * half_m.y * per_m)),
                           .margin = 1.4},
                          std::uint64_t{1} << 30U);
    while (maker.step(1'000'000)) {
    }
    for (std::size_t k = 0; k < ldi::patch_count; ++k) {
        result.made[k] = maker.patch(k);
        result.patches.patches[k] = result.made[k].get();
    }
    return result;
}

std::vector<Patched> all_patched(const WindowRig& rig, int samples) {
    std::vector<Patched> all;
    for (const Pinned& pinned : rig.pinned) {
        all.push_back(patched(rig, pinned, samples));
    }
    return all;
}

std::vector<scene::PlacedWindow> with_patches(const WindowRig& rig, const std::vector<Patched>& all) {
    std::vector<scene::PlacedWindow> windows = placed(rig.pinned);
    for (std::size_t k = 0; k < windows.size(); ++k) {
        windows[k].patches = &all[k].patches;
    }
    return windows;
}

/// How many of the windows of the latest plan were drawn by points.
std::size_t drawn_by_points(const scene::FramePlan& plan) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < plan.window_count; ++k) {
        const scene::FramePlan& window = plan.windows[k];
        count += window.relief_draw_count > 0 && window.relief_draws.front().points != nullptr ? 1U : 0U;
    }
    return count;
}

/// The pinning eye moved about the window by up to a quarter of its distance.
void move_eye(TestTable& table, std::mt19937& random) {
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    table.eye_m += 0.25 * table.eye_m.z * glm::dvec3(u(random), u(random), 0.5 * u(random));
}

void check_rays(int samples, const geometry::Lens& lens, bool points) {
    WindowRig rig(ball_and_post(), std::array{Way::Mesh, Way::Mesh, Way::Mesh}, samples, lens);
    std::mt19937 random(62);
    WindowCounts counts;
    std::size_t by_points = 0;
    for (int pose = 0; pose < 6; ++pose) {
        rig.table.shuffle(random);
        rig.table.eye_m.z = std::max(rig.table.eye_m.z, 0.6);
        rig.pin_some(random, 2);
        const std::vector<Patched> all = all_patched(rig, samples);
        move_eye(rig.table, random);
        const image::Image8 without = rig.world.picture(rig.view({}));
        const std::vector<scene::PlacedWindow> windows = with_patches(rig, all);
        const image::Image8 with = rig.world.picture(rig.view(windows));
        by_points += drawn_by_points(rig.world.plan);
        count_pixels(
            WindowTruth(rig.table, rig.pinned),
            {.outline_px = 1.5, .edge_px = samples == 1 ? 1.0 / 32.0 : 1.0}, without, with, part_of_code,
            [&](const glm::dvec3& from, const glm::dvec3& direction) { return rig.first(from, direction); },
            counts);
    }
    std::printf(
        "%zu windows of 12 by points; %zu pixels show something, %zu nothing; %zu at an outline, %zu at "
        "an edge; %zu wrong\n",
        by_points, counts.shown, counts.empty, counts.outline, counts.edge, counts.wrong);
    EXPECT_EQ(by_points > 6, points);
    EXPECT_EQ(by_points > 0, points);
    EXPECT_GT(counts.shown, 1000U);
    EXPECT_LE(counts.wrong, counts.windows() / 200); // as docs/ldi.md promises of pictures of patches
    EXPECT_LT(counts.outline, counts.windows() / 10);
}

TEST(WindowPatches, MatchRays) {
    check_rays(1, {}, true);
    check_rays(4, {}, true);
}

TEST(WindowPatches, AreNotUsedBehindADistortingLens) {
    check_rays(1, lenses[1], false);
}

/// Where one part is shown for two pixels around.
TEST(WindowPatches, HaveTheLightOfTheGeometry) {
    WindowRig rig(ball_and_post(), std::array{Way::Mesh, Way::Mesh, Way::Mesh}, 4);
    std::mt19937 random(7);
    double sum = 0.0;
    std::size_t count = 0;
    std::size_t by_points = 0;
    for (int pose = 0; pose < 4; ++pose) {
        rig.table.shuffle(random);
        rig.table.eye_m.z = std::max(rig.table.eye_m.z, 0.6);
        rig.pin_some(random, 2);
        const std::vector<Patched> all = all_patched(rig, 4);
        move_eye(rig.table, random);
        std::vector<scene::PlacedWindow> windows = with_patches(rig, all);
        for (scene::PlacedWindow& window : windows) {
            window.brightness = 0.7;
        }
        const image::Image8 points = rig.world.picture(rig.view(windows, scene::LightCompensation{}));
        by_points += drawn_by_points(rig.world.plan);
        for (scene::PlacedWindow& window : windows) {
            window.patches = nullptr;
        }
        const image::Image8 geometry = rig.world.picture(rig.view(windows, scene::LightCompensation{}));
        const WindowTruth truth(rig.table, rig.pinned);
        for (int y = 0; y < points.height; ++y) {
            for (int x = 0; x < points.width; ++x) {
                const glm::dvec2 pixel(x + 0.5, y + 0.5);
                const LitPlace lit = truth.at(pixel);
                if (lit.window < 0) {
                    continue;
                }
                const auto shown = [&](const glm::dvec2& at) {
                    const LitPlace place = truth.at(at);
                    const PropRay ray = truth.ray(lit.window, place.point);
                    return place.window == lit.window ? rig.first(ray.from, ray.direction) : -2;
                };
                const int part = shown(pixel);
                if (part < 0 ||
                    !truth.all_around(pixel, 2.0, [&](const glm::dvec2& at) { return shown(at) == part; })) {
                    continue;
                }
                const double off = points.at(x, y)[part] - geometry.at(x, y)[part];
                sum += off * off;
                ++count;
            }
        }
    }
    EXPECT_GT(by_points, 4U);
    ASSERT_GT(count, 500U);
    std::printf("RMSE %.2f codes over %zu pixels\n", std::sqrt(sum / static_cast<double>(count)), count);
    EXPECT_LE(std::sqrt(sum / static_cast<double>(count)), 2.0);
}

/// The difference over the pixels that `switched` changes.
struct Change {
    double rmse = 0.0;
    int most = 0; ///< of a channel, anywhere
};
Change change_of(const image::Image8& from, const image::Image8& to, const std::vector<bool>& switched) {
    Change change;
    std::size_t count = 0;
    for (std::size_t k = 0; k < from.texels.size(); ++k) {
        for (int channel = 0; channel < 3; ++channel) {
            const int off = static_cast<int>(to.texels[k][channel]) - from.texels[k][channel];
            change.most = std::max(change.most, std::abs(off));
            change.rmse += switched[k] ? static_cast<double>(off) * off : 0.0;
            count += switched[k] ? 1U : 0U;
        }
    }
    change.rmse = std::sqrt(change.rmse / static_cast<double>(std::max<std::size_t>(count, 1)));
    return change;
}

/// A window whose eye stands at the edge of the patches, so that a hair's breadth changes what draws it.
struct HandOver {
    WindowRig rig;
    std::vector<Patched> all;
    std::vector<scene::PlacedWindow> windows;
    scene::PointFade fade;
    long allocations = 0; ///< of the last frame, planned and drawn

    HandOver(Way way, int samples) : rig(as_one(ball_and_post()), std::array{Way::Mesh}, samples) {
        constexpr scene::WindowPlace place{.middle_m = {0.14, 0.0}, .width_m = 0.075, .depth_m = 0.075};
        rig.table.eye_m = {0.1, -0.2, 0.6};
        rig.pin(place);
        all = all_patched(rig, samples); // of the mesh
        rig.pinned.clear();
        rig.world.choose(std::array{way});
        rig.pin(place);
        windows = with_patches(rig, all);
    }
    /// The picture for an eye at this multiple of the distance at which the window was pinned, after so much of a fade.
    image::Image8 frame(double distance, double share) {
        scene::WindowPatches& patches = all.front().patches;
        const geometry::RigidTransform& from_window = rig.pinned.front().view.table_from_window;
        const glm::dvec3 eye =
            distance * patches.hemisphere.radius_m() * glm::normalize(glm::dvec3(0.1, -0.3, 1.0));
        rig.table.eye_m = from_window.point(eye);
        fade.step(scene::points_for(patches, eye), share);
        patches.eyes.front() = {.eye = eye, .shown = fade.shown()};
        patches.eye_count = 1;
        const scene::PlanView view = rig.view(windows, scene::LightCompensation{});
        Interlocked& world = rig.world;
        const long before = allocations_so_far();
        scene::plan_frame(world.prop, world.parts, view, world.plan);
        static_cast<void>(world.renderer->draw(world.plan,
                                               {world.display->framebuffer(), world.display->buffer_age()},
                                               render::Redraw::Everything));
        allocations = allocations_so_far() - before;
        return world.picture(view);
    }
};

/// No frame shows more than a small part of the difference, there and back, or allocates.
TEST(WindowPatches, FadeFromGeometryToPointsAndBack) {
    constexpr double beside = 1e-6;
    constexpr int frames = 30;
    for (const Way way : {Way::Mesh, Way::RasterizedRelief, Way::DrawnRelief}) {
        for (const int samples : {1, 4}) {
            if (samples == 1 && way == Way::DrawnRelief) {
                continue; // as a mesh, for the fade
            }
            HandOver window(way, samples);
            const image::Image8 geometry = window.frame(ldi::max_eye_share + beside, 1.0);
            ASSERT_EQ(drawn_by_points(window.rig.world.plan), 0U);
            const image::Image8 points = window.frame(ldi::max_eye_share - beside, 1.0);
            ASSERT_EQ(drawn_by_points(window.rig.world.plan), 1U);
            const std::string name = std::to_string(static_cast<int>(way)) + '_' + std::to_string(samples);
            keep_picture(geometry, "FADE_PICTURES", name + "_geometry");
            keep_picture(points, "FADE_PICTURES", name + "_points");
            std::vector<bool> switched(points.texels.size());
            for (std::size_t k = 0; k < switched.size(); ++k) {
                switched[k] = points.texels[k] != geometry.texels[k];
            }
            const Change at_once = change_of(geometry, points, switched);
            ASSERT_GT(at_once.most, 100) << "an outline moves";
            Change most;
            image::Image8 before = points;
            for (const double side : {beside, -beside}) {
                for (int frame = 0; frame < frames; ++frame) {
                    const image::Image8 next = window.frame(ldi::max_eye_share + side, 1.0 / frames);
                    if (frame == frames / 2) {
                        keep_picture(next, "FADE_PICTURES", name + (side > 0.0 ? "_back" : "_there"));
                    }
                    EXPECT_TRUE(frame == 0 || window.allocations == 0 || !allocations_are_counted)
                        << window.allocations << " in frame " << frame;
                    const Change change = change_of(before, next, switched);
                    most = {std::max(most.rmse, change.rmse), std::max(most.most, change.most)};
                    before = next;
                }
                const Change left = change_of(before, side > 0.0 ? geometry : points, switched);
                EXPECT_LE(left.most, 255 / frames + 1) << "the fade is over";
                before = side > 0.0 ? geometry : points;
                window.frame(ldi::max_eye_share + side, 1.0);
            }
            std::printf(
                "way %d, %d samples: RMSE %.2f, at most %d codes at once; %.2f, %d in a fade's frame\n",
                static_cast<int>(way), samples, at_once.rmse, at_once.most, most.rmse, most.most);
            EXPECT_LE(most.rmse, at_once.rmse / 15.0);
            EXPECT_LE(most.most, 255 / frames + 2);
        }
    }
}

/// A plan of points and one of geometry are not equal, nor are two patches.
TEST(WindowPatches, ChangeTheHashOfThePlan) {
    WindowRig rig(as_one(ball_and_post()), std::array{Way::Mesh});
    rig.table.eye_m = {0.1, -0.3, 0.7};
    rig.pin({.middle_m = {0.15, 0.0}, .width_m = 0.075, .depth_m = 0.075});
    ldi::PointPatch one, other;
    one.number = 1;
    other.number = 2;
    scene::WindowPatches patches{.hemisphere = ldi::Hemisphere(0.77),
                                 .box = {glm::dvec3(-0.05), glm::dvec3(0.0)}};
    std::vector<scene::PlacedWindow> windows = placed(rig.pinned);
    std::vector<std::uint64_t> hashes;
    for (const ldi::PointPatch* const patch :
         {static_cast<const ldi::PointPatch*>(nullptr), static_cast<const ldi::PointPatch*>(&one),
          static_cast<const ldi::PointPatch*>(&other)}) {
        patches.patches.fill(patch);
        windows.front().patches = &patches;
        (void)rig.world.picture(rig.view(windows));
        hashes.push_back(rig.world.plan.hash);
    }
    EXPECT_NE(hashes[0], hashes[1]);
    EXPECT_NE(hashes[1], hashes[2]);
}

} // namespace
} // namespace frustumscreen::synthetic
