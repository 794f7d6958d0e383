// Torches in windows, against rays: a window that is lit shows on each place of the world the light that the torch throws there in
// the prop, whoever looks into it, and the prop's own pixels stay as they are.

#include "tests/render/counted_new.h"
#include "tests/render/keep_picture.h"
#include "tests/render/torch_compare.h"
#include "tests/render/window_rig.h"

#include <array>
#include <string>

namespace frustumscreen::synthetic {
namespace {

struct LitWindow {
    std::string name;
    std::vector<WorldObject> objects;
    std::vector<Way> chosen;
    int samples = 1;
    std::size_t torches = 1;
    int poses = 12;
    double share =
        1.0; ///< of the world's ball behind the window; below 1 the window cuts off what reaches out of it
};

/// The torches that light the prop, as they light the window's world.
std::vector<scene::PlacedTorch> behind(const Pinned& pinned, const TestTable& table,
                                       std::span<const scene::PlacedTorch> torches) {
    std::vector<scene::PlacedTorch> moved;
    for (scene::PlacedTorch torch : torches) {
        torch.table_from_torch = table.table_from_prop.inverse() * torch.table_from_torch;
        moved.push_back(scene::moved_behind(pinned.view, pinned.view.table_from_window, torch));
    }
    return moved;
}

void check_light(const LitWindow& lit) {
    WindowRig rig(lit.objects, lit.chosen, lit.samples, {}, 1, true);
    for (scene::Part& part : rig.world.parts) {
        part.level.light = glm::vec3(base_light);
        part.level.beyond = lit.share < 1.0;
    }
    std::mt19937 random(49);
    Counts counts;
    for (int pose = 0; pose < lit.poses; ++pose) {
        rig.table.shuffle(random);
        rig.pinned.clear();
        rig.pin({.middle_m = {pose % 2 == 0 ? 0.15 : -0.15, 0.02},
                 .yaw_rad = 0.4 * pose,
                 .width_m = 0.1,
                 .depth_m = 0.09},
                lit.share);
        const TestTable pinned_at = rig.table;
        std::vector<scene::PlacedTorch> torches;
        for (std::size_t k = 0; k < lit.torches; ++k) {
            torches.push_back(seeded_torch(pinned_at, random, pose + 7 * static_cast<int>(k)));
        }
        if (pose % 3 != 0) { // another eye than the one that pinned, and the prop elsewhere
            rig.table.shuffle(random);
        }
        std::array<scene::PlacedWindow, 1> window{rig.pinned.front().placed()};
        const image::Image8 without = rig.world.picture(rig.view(window));
        const std::vector<scene::PlacedTorch> moved = behind(rig.pinned.front(), pinned_at, torches);
        window[0].torches = moved;
        const image::Image8 with = rig.world.picture(rig.view(window));
        keep_picture(with, "WINDOW_PICTURES", "light_" + lit.name + "_" + std::to_string(pose));
        const WindowTruth truth(rig.table, rig.pinned);
        const auto seen = [&](const glm::dvec2& pixel) {
            const glm::ivec2 at = glm::clamp(glm::ivec2(pixel), glm::ivec2(0),
                                             glm::ivec2(without.width - 1, without.height - 1));
            const LitPlace place = truth.at(pixel);
            if (place.prop || place.window < 0 || without.at(at.x, at.y) == glm::u8vec4(0, 0, 0, 255)) {
                return SeenPart{}; // also where the window ends before the prop
            }
            const PropRay ray = truth.ray(place.window, place.point);
            return lit.share < 1.0 ? front_on(rig.world, ray.from + ray.direction, ray.direction)
                                   : rig.world.first_on(ray.from, ray.direction);
        };
        const bool all_meshes = std::ranges::count(lit.chosen, Way::Mesh) == std::ssize(lit.chosen);
        Tolerance tolerance = all_meshes && lit.samples == 1 ? of_mesh : of_relief;
        tolerance.place_m /= rig.pinned.front().view.scale; // the window's world is smaller than the prop's
        Compared(rig.world, pinned_at, torches, tolerance,
                 truth.ray(0, glm::dvec3(rig.pinned.front().view.table_from_window.translation)).from, seen,
                 lit.share < 1.0 ? std::optional(rig.pinned.front().plane()) : std::nullopt)
            .count(without, with, counts);
    }
    std::printf(
        "%s: %zu lit, %zu dark, %zu of them in a shadow; excused: %zu at an outline, %zu at an edge of the "
        "light; %zu wrong, by up to %.2f codes more than allowed\n",
        lit.name.c_str(), counts.lit, counts.dark, counts.shadow, counts.outline, counts.edge, counts.wrong,
        counts.worst);
    const auto poses = static_cast<std::size_t>(lit.poses);
    const std::size_t pixels = counts.lit + counts.dark;
    EXPECT_GT(counts.lit, 100U * poses);
    EXPECT_GT(counts.dark, 100U * poses);
    EXPECT_GT(counts.shadow, 15U * poses);
    const bool exact =
        lit.samples == 1 && std::ranges::count(lit.chosen, Way::Mesh) == std::ssize(lit.chosen);
    EXPECT_LE(counts.wrong, pixels / (exact ? 20000 : 2000)) << "by up to " << counts.worst << " codes";
    EXPECT_LT(counts.outline, pixels / (exact ? 20 : 5));
    EXPECT_LT(counts.edge, pixels / (exact ? 20 : 5));
}

TEST(WindowLight, MatchesRaysOnMeshes) {
    check_light({.name = "mesh", .objects = as_one(ball_and_post()), .chosen = {Way::Mesh}});
    check_light(
        {.name = "two", .objects = as_one(ball_and_post()), .chosen = {Way::Mesh}, .torches = 2, .poses = 6});
}

TEST(WindowLight, MatchesRaysOnReliefs) {
    check_light({.name = "raster", .objects = as_one(ball_and_post()), .chosen = {Way::RasterizedRelief}});
    check_light(
        {.name = "gpu", .objects = as_one(ball_and_post()), .chosen = {Way::DrawnRelief}, .poses = 4});
}

TEST(WindowLight, MatchesRaysOnCells) {
    check_light({.name = "cells",
                 .objects = ball_and_post(),
                 .chosen = {Way::RasterizedRelief, Way::Mesh, Way::RasterizedRelief}});
}

TEST(WindowLight, MatchesRaysWithFourSamples) {
    check_light({.name = "samples",
                 .objects = ball_and_post(),
                 .chosen = {Way::Mesh, Way::Mesh, Way::Mesh},
                 .samples = 4});
}

/// As the part of a site: it goes on before the window, where it is cut off and casts no shadows.
TEST(WindowLight, MatchesRaysOnAWorldBeyondItsWindow) {
    check_light({.name = "beyond", .objects = as_one(ball_and_post()), .chosen = {Way::Mesh}, .share = 0.6});
    check_light({.name = "beyond_cells",
                 .objects = ball_and_post(),
                 .chosen = {Way::Mesh, Way::Mesh, Way::Mesh},
                 .share = 0.5});
    check_light({.name = "beyond_samples",
                 .objects = ball_and_post(),
                 .chosen = {Way::Mesh, Way::Mesh, Way::Mesh},
                 .samples = 4,
                 .share = 0.6});
}

/// The prop's face that is farthest from the torch.
std::optional<geometry::Plane> cut_before(const TestTable& table, const scene::PlacedTorch& torch) {
    const glm::dvec3 from = table.table_from_prop.inverse().point(torch.table_from_torch.translation);
    std::optional<geometry::Plane> cut;
    for (const geometry::PropFace& face : table.prop.faces) {
        const double away = face.plane.distance(from);
        if (away > 0.0 && (!cut || away > cut->distance(from))) {
            cut = face.plane;
        }
    }
    return cut;
}

/// As the part of a site in the prop.
TEST(WindowLight, MatchesRaysOnAWorldBeyondTheProp) {
    for (const int samples : {1, 4}) {
        Interlocked world(geometry::make_frustum({}), ball_and_post(), samples, {}, 256, true);
        world.choose(std::array{Way::Mesh, Way::Mesh, Way::Mesh});
        for (scene::Part& part : world.parts) {
            part.level.light = glm::vec3(base_light);
            part.level.beyond = true;
        }
        TestTable table = table_of({});
        table.prop = world.prop = geometry::make_frustum({.base_m = 0.12, .top_m = 0.08, .height_m = 0.07});
        std::mt19937 random(65);
        Counts counts;
        for (int pose = 0; pose < 12; ++pose) {
            table.shuffle(random);
            const std::array torches{seeded_torch(table, random, pose)};
            scene::PlanView view = table.view();
            const image::Image8 without = world.picture(view);
            view.torches = torches;
            const image::Image8 with = world.picture(view);
            keep_picture(with, "WINDOW_PICTURES",
                         "light_prop_" + std::to_string(samples) + "_" + std::to_string(pose));
            const glm::dvec3 eye = table.table_from_prop.inverse().point(table.eye_m);
            const auto seen = [&](const glm::dvec2& pixel) {
                const std::optional<ReferenceCast::Ray> ray = ReferenceCast::ray_of(table, pixel);
                const glm::ivec2 at = glm::clamp(glm::ivec2(pixel), glm::ivec2(0),
                                                 glm::ivec2(without.width - 1, without.height - 1));
                return ray && without.at(at.x, at.y) != glm::u8vec4(0, 0, 0, 255)
                           ? front_on(world, ray->lit, ray->lit - ray->eye)
                           : SeenPart{};
            };
            Compared(world, table, torches, samples == 1 ? of_mesh : of_relief, eye, seen,
                     cut_before(table, torches[0]))
                .count(without, with, counts);
        }
        std::printf(
            "%d samples: %zu lit, %zu dark, %zu of them in a shadow; excused: %zu at an outline, %zu at "
            "an edge of the light; %zu wrong, by up to %.2f codes\n",
            samples, counts.lit, counts.dark, counts.shadow, counts.outline, counts.edge, counts.wrong,
            counts.worst);
        const std::size_t pixels = counts.lit + counts.dark;
        EXPECT_GT(counts.lit, 2000U);
        EXPECT_GT(counts.shadow, 200U);
        EXPECT_LE(counts.wrong, pixels / (samples == 1 ? 20000 : 2000)) << "by up to " << counts.worst;
        EXPECT_LT(counts.outline + counts.edge, pixels / 5);
    }
}

/// A world of the prop and two windows, each lit or not.
struct LitBoth {
    WindowRig rig;
    std::vector<scene::PlacedTorch> on_prop;
    std::array<std::vector<scene::PlacedTorch>, 2> on_window;

    LitBoth(std::span<const Way> chosen, int samples) : rig(ball_and_post(), chosen, samples, {}, 2, true) {
        for (scene::Part& part : rig.world.parts) {
            part.level.light = glm::vec3(base_light);
        }
        std::mt19937 random(5);
        rig.table.shuffle(random);
        for (std::size_t k = 0; k < 2; ++k) {
            rig.pin({.middle_m = {k == 0 ? 0.15 : -0.15, 0.02}, .width_m = 0.08, .depth_m = 0.08});
            const std::array torch{wide_torch(k == 0 ? 0.2 : -0.2)};
            on_window[k] = behind(rig.pinned[k], rig.table, torch);
        }
        on_prop = {wide_torch(0.0)};
    }
    /// Beside the visitor, `aside` metres.
    [[nodiscard]] scene::PlacedTorch wide_torch(double aside) const {
        const glm::dvec3 middle = rig.table.table_from_prop.point(rig.table.prop.middle);
        torch::Beam beam;
        beam.opening_rad = 0.6;
        beam.attenuation = torch::Attenuation::None;
        return torch_of(looking(rig.table.eye_m + glm::dvec3(aside, 0.0, 0.1), middle), beam);
    }
    /// `lit`: the prop, the first and the second window.
    scene::PlanView view(std::array<bool, 3> lit) {
        windows = placed(rig.pinned);
        for (std::size_t k = 0; k < 2; ++k) {
            windows[k].torches = lit[k + 1] ? on_window[k] : std::span<const scene::PlacedTorch>();
        }
        scene::PlanView made = rig.view(windows);
        made.torches = lit[0] ? on_prop : std::span<const scene::PlacedTorch>();
        return made;
    }
    image::Image8 picture(std::array<bool, 3> lit) { return rig.world.picture(view(lit)); }
    std::vector<scene::PlacedWindow> windows;
};

constexpr std::array all_meshes{Way::Mesh, Way::Mesh, Way::Mesh};
constexpr std::array mixed{Way::RasterizedRelief, Way::Mesh, Way::DrawnRelief};

/// Prop and windows share the torches' pictures, one after the other.
TEST(WindowLight, LightsOnlyItsOwnSurface) {
    for (const int samples : {1, 4}) {
        for (const auto& chosen : {all_meshes, mixed}) {
            LitBoth both(chosen, samples);
            const image::Image8 dark = both.picture({false, false, false});
            const image::Image8 all = both.picture({true, true, true});
            const std::array<image::Image8, 3> each{both.picture({true, false, false}),
                                                    both.picture({false, true, false}),
                                                    both.picture({false, false, true})};
            const WindowTruth truth(both.rig.table, both.rig.pinned);
            std::array<std::size_t, 3> lit{};
            std::size_t wrong = 0;
            for (int y = 0; y < dark.height; ++y) {
                for (int x = 0; x < dark.width; ++x) {
                    const LitPlace place = truth.at({x + 0.5, y + 0.5});
                    if (!place.prop && place.window < 0) {
                        continue; // the edge of a window may light a pixel beside it
                    }
                    const auto own = static_cast<std::size_t>(place.prop ? 0 : place.window + 1);
                    for (std::size_t k = 0; k < 3; ++k) {
                        const bool differs = each[k].at(x, y) != dark.at(x, y);
                        lit[k] += differs ? 1U : 0U;
                        wrong += differs && k != own ? 1U : 0U;
                    }
                    wrong += all.at(x, y) != each[own].at(x, y) ? 1U : 0U;
                }
            }
            for (const std::size_t count : lit) {
                EXPECT_GT(count, 20U);
            }
            EXPECT_LE(wrong, samples == 1 ? 0U : 4U) << samples; // a pixel on a border has samples of both
        }
    }
}

TEST(WindowLight, ChangesThePlanOnlyWhenPresent) {
    LitBoth both(mixed, 4);
    WindowRig plain(ball_and_post(), mixed, 4, {}, 2);
    for (scene::Part& part : plain.world.parts) {
        part.level.light = glm::vec3(base_light);
    }
    scene::plan_frame(both.rig.world.prop, both.rig.world.parts, both.view({false, false, false}),
                      both.rig.world.plan);
    const std::uint64_t unlit = both.rig.world.plan.hash;
    scene::plan_frame(both.rig.world.prop, both.rig.world.parts, both.view({false, false, false}),
                      plain.world.plan);
    EXPECT_EQ(plain.world.plan.hash, unlit);
    scene::plan_frame(both.rig.world.prop, both.rig.world.parts, both.view({false, true, false}),
                      both.rig.world.plan);
    EXPECT_NE(both.rig.world.plan.hash, unlit);
    EXPECT_EQ(both.rig.world.plan.windows[0].torches.size(), 1U);
    EXPECT_TRUE(both.rig.world.plan.windows[1].torches.empty());
    scene::plan_frame(both.rig.world.prop, both.rig.world.parts, both.view({false, true, true}),
                      plain.world.plan);
    EXPECT_EQ(plain.world.plan.hash, unlit) << "its windows have no room for torches";
}

TEST(WindowLight, PlanningAllocatesNothing) {
    if (!allocations_are_counted) {
        GTEST_SKIP() << "allocations are not counted under a sanitizer";
    }
    LitBoth both(mixed, 4);
    static_cast<void>(both.picture({true, true, true}));
    for (int frame = 0; frame < 4; ++frame) {
        both.rig.table.eye_m.x += 0.01;
        const scene::PlanView view = both.view({true, true, true});
        const long before = allocations_so_far();
        scene::plan_frame(both.rig.world.prop, both.rig.world.parts, view, both.rig.world.plan);
        EXPECT_EQ(allocations_so_far() - before, 0);
        const scene::FramePlan& plan = both.rig.world.plan;
        EXPECT_EQ(plan.torches.size(), 1U);
        ASSERT_EQ(plan.window_count, 2U);
        for (std::size_t k = 0; k < plan.window_count; ++k) {
            EXPECT_EQ(plan.windows[k].torches.size(), 1U) << k;
            EXPECT_GT(plan.windows[k].draws.size() + plan.windows[k].relief_draw_count, 0U) << k;
        }
    }
}

} // namespace
} // namespace frustumscreen::synthetic
