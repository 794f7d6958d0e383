// Windows in a frame: without them nothing is planned, a change redraws only the surfaces that it meets, nothing is allocated, and
// windows cover pictures on the table.

#include "tests/render/counted_new.h"
#include "tests/render/stereo_rig.h"
#include "tests/render/window_rig.h"

namespace frustumscreen::synthetic {
namespace {

TEST(WindowsInAFrame, DoNotChangeThePlanOfTheProp) {
    WindowRig rig(ball_and_post(), std::array{Way::Mesh, Way::RasterizedRelief, Way::DrawnRelief}, 4);
    scene::FramePlan plain = scene::make_plan(rig.world.prop, 100'000, 3);
    std::mt19937 random(1);
    for (int pose = 0; pose < 8; ++pose) {
        rig.table.shuffle(random);
        const scene::PlanView view = rig.view({}, scene::LightCompensation{});
        scene::plan_frame(rig.world.prop, rig.world.parts, view, rig.world.plan);
        scene::plan_frame(rig.world.prop, rig.world.parts, view, plain);
        EXPECT_EQ(rig.world.plan.window_count, 0U);
        EXPECT_EQ(rig.world.plan.hash, plain.hash);
        EXPECT_EQ(rig.world.plan.indices, plain.indices);
        // With windows the prop's part of the plan is the same.
        rig.pin_some(random, 2);
        const std::vector<scene::PlacedWindow> windows = placed(rig.pinned);
        scene::plan_frame(rig.world.prop, rig.world.parts, rig.view(windows, scene::LightCompensation{}),
                          rig.world.plan);
        EXPECT_EQ(rig.world.plan.window_count, 2U);
        EXPECT_EQ(rig.world.plan.prop_hash, plain.prop_hash);
        EXPECT_NE(rig.world.plan.hash, plain.hash);
        EXPECT_EQ(rig.world.plan.indices, plain.indices);
        EXPECT_EQ(rig.world.plan.draws.size(), plain.draws.size());
        EXPECT_EQ(rig.world.plan.lit.bounds(), plain.lit.bounds());
        EXPECT_EQ(rig.world.plan.samples, plain.samples);
        // A plan without room has none.
        scene::plan_frame(rig.world.prop, rig.world.parts, rig.view(windows, scene::LightCompensation{}),
                          plain);
        EXPECT_EQ(plain.window_count, 0U);
    }
}

/// A further window, the eye or the prop changes: the change is drawn again, and the picture equals a whole redraw.
TEST(WindowsInAFrame, PartialRedrawEqualsFullRedraw) {
    for (const int samples : {1, 4}) {
        for (const auto& chosen : {std::array{Way::Mesh, Way::Mesh, Way::Mesh},
                                   std::array{Way::RasterizedRelief, Way::Mesh, Way::DrawnRelief}}) {
            WindowRig whole(ball_and_post(), chosen, samples);
            WindowRig changes(ball_and_post(), chosen, samples);
            std::mt19937 random(7);
            std::uniform_real_distribution<double> u(-1.0, 1.0);
            whole.table.shuffle(random);
            whole.pin_some(random, 2);
            for (int k = 0; k < 24; ++k) {
                switch (k % 6) {
                case 0:
                    whole.table.eye_m += 0.05 * glm::dvec3(u(random), u(random), 0.5 * u(random));
                    break;
                case 1:
                case 2:
                    whole.table.table_from_prop.translation += 0.02 * glm::dvec3(u(random), u(random), 0.0);
                    break;
                case 3:
                    whole.pin_some(random, static_cast<std::size_t>(k / 6));
                    break;
                default:
                    break; // nothing changes
                }
                changes.table = whole.table;
                changes.pinned = whole.pinned;
                const image::Image8 expected = whole.picture(scene::LightCompensation{});
                const std::vector<scene::PlacedWindow> windows = placed(changes.pinned);
                Interlocked& world = changes.world;
                scene::plan_frame(world.prop, world.parts, changes.view(windows, scene::LightCompensation{}),
                                  world.plan);
                const render::DrawResult drawn = world.renderer->draw(
                    world.plan, {world.display->framebuffer(), k == 0 ? 0 : world.display->buffer_age()});
                EXPECT_EQ(drawn.drawn, k % 6 < 4) << k;
                if (drawn.drawn) {
                    EXPECT_TRUE(world.display->present(MonotonicTime{}));
                }
                const image::Image8 shown = render::read_colour(
                    world.display->framebuffer(), world.display->width(), world.display->height());
                const Difference found = difference(shown, expected);
                EXPECT_EQ(found.pixels, 0U) << k << ", samples " << samples << ", by up to " << found.worst;
            }
        }
    }
}

TEST(WindowsInAFrame, RedrawsOnlyTheChangedWindow) {
    WindowRig rig(as_one(ball_and_post()), std::array{Way::Mesh}, 4);
    for (const double side : {-1.0, 1.0}) {
        rig.pin({.middle_m = {0.15 * side, 0.0}, .width_m = 0.05, .depth_m = 0.05});
    }
    static_cast<void>(rig.picture());
    rig.pinned[1].parts[0].level.light = glm::vec3(0.5F);
    const std::vector<scene::PlacedWindow> windows = placed(rig.pinned);
    scene::plan_frame(rig.world.prop, rig.world.parts, rig.view(windows), rig.world.plan);
    const render::DrawResult drawn = rig.world.renderer->draw(
        rig.world.plan, {rig.world.display->framebuffer(), rig.world.display->buffer_age()});
    EXPECT_TRUE(drawn.drawn);
    EXPECT_EQ(drawn.redrawn, scene::bounds_in_prop(rig.world.plan.windows[1]));
    EXPECT_EQ(united(drawn.lit, scene::bounds_in_prop(rig.world.plan.windows[0])), drawn.lit);
}

/// A window covers pictures on the table, as the prop does, and neither covers a picture `on_prop`.
TEST(WindowsInAFrame, CoverPicturesOnTheTable) {
    WindowRig rig(as_one(ball_and_post()), std::array{Way::Mesh}, 4);
    rig.pin({.middle_m = {0.14, 0.0}, .width_m = 0.07, .depth_m = 0.07});
    const image::Image8 dark = rig.picture();
    image::Image8 white(8, 8);
    std::fill(white.texels.begin(), white.texels.end(), glm::u8vec4(255));
    const scene::TextureId texture =
        rig.world.renderer->store().upload_picture(std::vector{std::move(white)}).value();
    const auto strip = [&](double y, bool on_prop) {
        return scene::TablePicture{.corners_m = {glm::dvec3(0.09, y + 0.01, 0.0),
                                                 {0.185, y + 0.01, 0.0},
                                                 {0.185, y, 0.0},
                                                 {0.09, y, 0.0}},
                                   .texture = texture,
                                   .on_prop = on_prop};
    };
    const std::array pictures{strip(0.01, false), strip(-0.02, true)};
    const std::vector<scene::PlacedWindow> windows = placed(rig.pinned);
    scene::PlanView view = rig.view(windows);
    view.on_table = pictures;
    const image::Image8 lit = rig.world.picture(view);
    const WindowTruth truth(rig.table, rig.pinned);
    std::size_t covered = 0;
    std::size_t on_window = 0;
    std::size_t on_table = 0;
    for (int y = 0; y < lit.height; ++y) {
        for (int x = 0; x < lit.width; ++x) {
            const LitPlace at = truth.at({x + 0.5, y + 0.5});
            const auto in = [&](double low) {
                return !at.prop && at.point.x > 0.092 && at.point.x < 0.183 && at.point.y > low + 0.002 &&
                       at.point.y < low + 0.008;
            };
            const bool deep_in_window =
                at.window >= 0 && truth.all_around({x + 0.5, y + 0.5}, 2.0, [&](const glm::dvec2& beside) {
                    return truth.at(beside).window >= 0;
                });
            const bool empty = dark.at(x, y) == glm::u8vec4(0, 0, 0, 255);
            if (in(0.01) && deep_in_window) {
                ++covered;
                EXPECT_EQ(lit.at(x, y), dark.at(x, y)) << x << ' ' << y;
            } else if (in(-0.02) && deep_in_window && empty) {
                ++on_window;
                EXPECT_EQ(lit.at(x, y), glm::u8vec4(255)) << x << ' ' << y;
            } else if ((in(0.01) || in(-0.02)) && at.window < 0 &&
                       truth.all_around({x + 0.5, y + 0.5}, 2.0, [&](const glm::dvec2& beside) {
                           return truth.at(beside).window < 0 && !truth.at(beside).prop;
                       })) {
                ++on_table;
                EXPECT_EQ(lit.at(x, y), glm::u8vec4(255)) << x << ' ' << y;
            }
        }
    }
    EXPECT_GT(covered, 100U);
    EXPECT_GT(on_window, 50U);
    EXPECT_GT(on_table, 50U);
}

TEST(WindowsInAFrame, AFrameAllocatesNothing) {
    if (!allocations_are_counted) {
        GTEST_SKIP() << "allocations are not counted under a sanitizer";
    }
    for (const auto& chosen : {std::array{Way::RasterizedRelief, Way::Mesh, Way::RasterizedRelief},
                               std::array{Way::Mesh, Way::DrawnRelief, Way::Mesh}}) {
        WindowRig rig(ball_and_post(), chosen, 4);
        std::mt19937 random(5);
        rig.table.shuffle(random);
        rig.pin_some(random, 2);
        const std::vector<scene::PlacedWindow> windows = placed(rig.pinned);
        std::vector<TestTable> tables;
        for (int k = 0; k < 4; ++k) {
            rig.table.shuffle(random);
            tables.push_back(rig.table);
        }
        long counted = 0;
        for (int k = 0; k < 20; ++k) { // the first rounds reserve memory for the fullest view
            scene::PlanView view = tables[static_cast<std::size_t>(k) % tables.size()].view();
            view.light = scene::LightCompensation{};
            view.windows = windows;
            const long before = allocations_so_far();
            scene::plan_frame(rig.world.prop, rig.world.parts, view, rig.world.plan);
            static_cast<void>(rig.world.renderer->draw(
                rig.world.plan, {rig.world.display->framebuffer(), rig.world.display->buffer_age()},
                render::Redraw::Everything));
            counted += k < 16 ? 0 : allocations_so_far() - before;
        }
        EXPECT_EQ(counted, 0);
    }
}

/// The eye is on the window's plane, behind it or straight above, or the window is at the picture's edge or beyond: no pixel beside the
/// window is lit.
TEST(WindowsInAFrame, AreDarkFromBehind) {
    for (const Way way : ways) {
        WindowRig rig(as_one(ball_and_post()), std::array{way});
        rig.pin({.middle_m = {0.14, 0.0}, .width_m = 0.07, .depth_m = 0.07});
        for (const glm::dvec3& eye : {glm::dvec3(0.3, 0.0, 0.0), glm::dvec3(0.3, 0.1, -0.2),
                                      glm::dvec3(0.14, 0.0, 0.0), glm::dvec3(0.3, 0.0, 1e-12)}) {
            rig.table.eye_m = eye;
            const scene::PlacedLevel nothing;
            const std::vector<scene::PlacedWindow> windows = placed(rig.pinned);
            const scene::Part none{nothing, std::nullopt};
            const image::Image8 shown = rig.world.picture(rig.view(windows), std::span(&none, 1));
            EXPECT_EQ(lit_pixels(shown), 0U) << eye.x << ' ' << eye.z << ' ' << static_cast<int>(way);
        }
        rig.table.eye_m = {0.14, 0.0, 0.5};
        EXPECT_GT(lit_pixels(rig.picture()), 500U);
    }
}

} // namespace
} // namespace frustumscreen::synthetic
