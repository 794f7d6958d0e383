// The patches of frozen windows: a thread that is slow never holds up a frame, and a frame that freezes a window allocates nothing.
#include "app/show/frozen_windows.h"
#include "tests/base/comes_true.h"
#include "tests/render/counted_new.h"
#include "tests/show/shown_packs.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <thread>

namespace frustumscreen::show {
namespace {

using std::chrono::milliseconds;

FrozenWorld a_wall() {
    FrozenWorld world;
    ldi::TriangleWorld& wall = world.worlds.emplace_back();
    wall.positions = {
        {-0.3F, -0.3F, -0.05F}, {0.3F, -0.3F, -0.05F}, {0.3F, 0.3F, -0.05F}, {-0.3F, 0.3F, -0.05F}};
    wall.indices = {0, 1, 2, 0, 2, 3};
    wall.colours.assign(4, glm::u8vec4(200, 100, 50, 255));
    world.box = {{-0.3, -0.3, -0.05}, {0.3, 0.3, -0.05}};
    return world;
}

PatchJobSetUp set_up(const std::function<Result<FrozenWorld>()>& make_world) {
    return {.make_world = std::make_shared<const WorldMaker>(
                [make_world](const LevelInWindow& /*shown*/) { return make_world(); }),
            .shown = {},
            .radius_m = 0.5,
            .view = {.half_extent_m = glm::dvec2(0.05), .width = 32, .height = 32}};
}

exhibit::PresentedWindow presented(std::uint32_t number) {
    exhibit::PresentedWindow window;
    window.number = number;
    return window;
}

constexpr glm::dvec3 above{0.0, 0.0, 0.5};
constexpr MonotonicTime now{std::chrono::seconds(100)};

/// Draws frames until the patch of the eye is there; false: it did not come.
bool comes(FrozenWindows& windows, std::uint32_t number, const glm::dvec3& eye) {
    return comes_true([&] {
        const scene::WindowPatches* const patches = windows.look(number, {&eye, 1}, now);
        const exhibit::PresentedWindow shown = presented(number);
        windows.step({&shown, 1});
        return patches != nullptr && scene::points_for(*patches, eye) != nullptr;
    });
}

TEST(FrozenWindows, FramesDoNotWaitForAHangingThread) {
    FrozenWindows windows({}, false);
    std::promise<void> opens;
    std::shared_future<void> open = opens.get_future().share();
    std::atomic<bool> reads{false};
    windows.begin(1, set_up([&]() -> Result<FrozenWorld> {
                      reads = true;
                      open.wait();
                      return a_wall();
                  }));
    const exhibit::PresentedWindow shown = presented(1);
    windows.step({&shown, 1});
    while (!reads) {
        std::this_thread::sleep_for(milliseconds(1));
    }
    for (int frame = 0; frame < 1000; ++frame) { // the thread reads, and none of these waits for it
        const scene::WindowPatches* const patches = windows.look(1, {&above, 1}, now);
        ASSERT_NE(patches, nullptr);
        EXPECT_EQ(scene::points_for(*patches, above), nullptr) << "the window is drawn by its parts";
        windows.step({&shown, 1});
    }
    opens.set_value();
    EXPECT_TRUE(comes(windows, 1, above));
}

TEST(FrozenWindows, MakesThePatchForEveryDirectionOfTheEye) {
    FrozenWindows windows({}, false);
    windows.begin(7, set_up([]() -> Result<FrozenWorld> { return a_wall(); }));
    const ldi::Hemisphere hemisphere(0.5);
    for (std::size_t patch = 0; patch < ldi::patch_count; ++patch) {
        EXPECT_TRUE(comes(windows, 7, 0.5 * hemisphere.middle_of(patch))) << patch;
    }
    const glm::dvec3 low(0.49, 0.0, 0.05), far(0.0, 0.0, 1.2), near(0.0, 0.0, 0.2);
    for (const glm::dvec3& eye : {low, far, near}) {
        EXPECT_EQ(scene::points_for(*windows.look(7, {&eye, 1}, now), eye), nullptr) << "beyond the patches";
    }
}

TEST(FrozenWindows, AWorldThatCannotBeReadHasNoPatches) {
    FrozenWindows windows({}, true);
    windows.begin(1, set_up([]() -> Result<FrozenWorld> { return bad_input("test.gone", "gone"); }));
    EXPECT_EQ(scene::points_for(*windows.look(1, {&above, 1}, now), above), nullptr);
}

TEST(FrozenWindows, WaitingModeMakesAllPatchesInTheFirstFrameWithoutAThread) {
    FrozenWindows windows({}, true);
    windows.begin(1, set_up([]() -> Result<FrozenWorld> { return a_wall(); }));
    const scene::WindowPatches& patches = *windows.look(1, {&above, 1}, now);
    for (const ldi::PointPatch* const patch : patches.patches) {
        ASSERT_NE(patch, nullptr);
    }
    EXPECT_FALSE(windows.has_thread());
}

/// Draws a frame, and returns the share of points that the eye is shown in it.
double share_at(FrozenWindows& windows, MonotonicTime time, const glm::dvec3& eye) {
    const scene::ShownPoints shown = scene::shown_to(*windows.look(1, {&eye, 1}, time), eye);
    const exhibit::PresentedWindow window = presented(1);
    windows.step({&window, 1});
    return shown.points != nullptr ? static_cast<double>(shown.share) : 0.0;
}

TEST(FrozenWindows, FadeToTheirPatchesAndBackInHalfASecond) {
    FrozenWindows windows({}, false);
    windows.begin(1, set_up([]() -> Result<FrozenWorld> { return a_wall(); }));
    ASSERT_TRUE(comes(windows, 1, above));
    MonotonicTime time = now;
    double share = share_at(windows, time, above);
    EXPECT_EQ(share, 0.0) << "no time has passed";
    const glm::dvec3 far(0.0, 0.0, 0.76);
    for (const glm::dvec3& eye : {above, far, above}) {
        const double goal = eye == far ? 0.0 : 1.0;
        for (int frame = 1; frame <= 24; ++frame) { // of a fiftieth of a second
            time += milliseconds(20);
            const double next = share_at(windows, time, eye);
            EXPECT_NEAR(next - share, (goal - 0.5) * 0.08, 1e-5) << frame;
            EXPECT_TRUE(windows.fades()) << frame;
            share = next;
        }
        time += milliseconds(100);
        share = share_at(windows, time, eye);
        EXPECT_EQ(share, goal);
        EXPECT_FALSE(windows.fades());
    }
    // An eye that comes back meanwhile turns the fade around.
    share_at(windows, time += milliseconds(100), far);
    EXPECT_NEAR(share_at(windows, time += milliseconds(100), far), 0.6, 1e-5);
    EXPECT_NEAR(share_at(windows, time += milliseconds(100), above), 0.8, 1e-5);
    const exhibit::PresentedWindow dark = presented(1); // nobody looks at it
    windows.step({&dark, 1});
    EXPECT_FALSE(windows.fades());
}

TEST(FrozenWindows, EachEyeHasItsOwnFade) {
    FrozenWindows windows({}, false);
    windows.begin(1, set_up([]() -> Result<FrozenWorld> { return a_wall(); }));
    ASSERT_TRUE(comes(windows, 1, above));
    const std::array eyes{glm::dvec3(0.0, 0.0, 0.74),
                          glm::dvec3(0.0, 0.0, 0.76)}; // the second is beyond the patches
    const scene::WindowPatches& patches = *windows.look(1, eyes, now + milliseconds(250));
    EXPECT_NEAR(scene::shown_to(patches, eyes[0]).share, 0.5F, 1e-5F);
    EXPECT_NE(scene::shown_to(patches, eyes[0]).points, nullptr);
    EXPECT_EQ(scene::shown_to(patches, eyes[1]).points, nullptr);
}

TEST(FrozenWindows, SwitchToPatchesAtOnceInSimulatedTime) {
    FrozenWindows windows({}, true);
    windows.begin(1, set_up([]() -> Result<FrozenWorld> { return a_wall(); }));
    EXPECT_EQ(share_at(windows, now, above), 1.0);
    EXPECT_EQ(share_at(windows, now, {0.0, 0.0, 0.76}), 0.0);
    EXPECT_EQ(share_at(windows, now, above), 1.0);
}

TEST(FrozenWindows, AreDrawnByTheirPartsWhileAllJobsAreTaken) {
    std::atomic<bool> is_hanging{false};
    FrozenWindows windows({}, false);
    std::promise<void> opens;
    std::shared_future<void> open = opens.get_future().share();
    const auto hangs = [open, &is_hanging]() -> Result<FrozenWorld> {
        is_hanging = true;
        is_hanging.notify_all();
        open.wait();
        return a_wall();
    };
    std::uint32_t number = 0;
    for (int k = 0; k < 20; ++k) { // frozen again and again, while the thread hangs in the first
        windows.begin(++number, set_up(hangs));
        const exhibit::PresentedWindow shown = presented(number);
        windows.step({&shown, 1});
        is_hanging.wait(false); // otherwise the thread frees the jobs that were left before it began
        const scene::WindowPatches* const patches = windows.look(number, {&above, 1}, now);
        EXPECT_TRUE(patches == nullptr || scene::points_for(*patches, above) == nullptr);
        EXPECT_EQ(windows.size(), 1U);
    }
    EXPECT_EQ(windows.look(number, {&above, 1}, now), nullptr) << "all jobs are taken";
    opens.set_value();
    EXPECT_TRUE(comes(windows, number, above));
    windows.begin(++number, set_up([]() -> Result<FrozenWorld> { return a_wall(); }));
    EXPECT_TRUE(comes(windows, number, above)) << "a job serves one window after the other";
}

scene::PlacedLevel level_of(std::size_t triangles) {
    auto level = std::make_shared<scene::LevelTriangles>();
    level->indices.resize(3 * triangles);
    scene::PlacedLevel placed;
    placed.triangles = std::move(level);
    placed.samples = 4;
    return placed;
}

TEST(FrozenWindows, UsePatchesOnlyWhereTheyAreQuicker) {
    PatchView view;
    view.cameras.width = view.cameras.height = 320;
    view.samples = 4;
    const scene::FrameCost software{.mesh = {.fixed_ms = 5.0, .ms_per_triangle = 5e-5, .ms_per_sample = 1e-5},
                                    .raster = {},
                                    .on_gpu = {}};
    EXPECT_TRUE(patches_are_quicker(software, level_of(200'000), view));
    EXPECT_FALSE(patches_are_quicker(software, level_of(10'000), view));
    scene::FrameCost quick = software;
    quick.mesh.ms_per_triangle = quick.mesh.ms_per_sample = 1e-7;
    EXPECT_FALSE(patches_are_quicker(quick, level_of(200'000), view)) << "a GPU that draws them at once";
    EXPECT_FALSE(patches_are_quicker({}, level_of(200'000), view)) << "no cost is known";
}

TEST(FrozenWindows, FreezingAWindowAllocatesNothing) {
    if (!synthetic::allocations_are_counted) {
        GTEST_SKIP() << "allocations are not counted under a sanitizer";
    }
    const synthetic::ShownPacks files(1);
    const residency::KnownArtifact known = files.known(0);
    const std::array artifacts{&known};
    FrozenWindows windows(settings::steep_table().projector, false);
    windows.make_space(artifacts);
    windows.set_cost(
        {.mesh = {.fixed_ms = 5.0, .ms_per_triangle = 1.0, .ms_per_sample = 1e-3}, // patches are quicker
         .raster = {},
         .on_gpu = {}});
    const scene::PinnedView view = scene::pin_view({.table_from_prop = {},
                                                    .prop_middle = {0.0, 0.0, 0.1},
                                                    .eye_m = {0.0, -0.5, 0.6},
                                                    .world = {.middle = {0.0, 0.0, 0.1}, .radius = 0.1},
                                                    .place = {}})
                                       .value();
    const std::array<scene::Part, 1> parts{{{level_of(2000), std::nullopt}}};
    for (const std::uint32_t number : {1U, 2U, 3U}) {
        const exhibit::PresentedWindow shown = presented(number);
        const long before = synthetic::allocations_so_far();
        windows.freeze({.number = number,
                        .artifact = 0,
                        .known = known,
                        .shown = {.level = 1},
                        .parts = parts,
                        .view = view,
                        .eye_m = {0.0, -0.5, 0.6}});
        const scene::WindowPatches* const patches = windows.look(number, {&above, 1}, now);
        windows.step({&shown, 1});
        EXPECT_EQ(synthetic::allocations_so_far() - before, 0) << number;
        EXPECT_NE(patches, nullptr) << "patches are made";
    }
}

TEST(FrozenWindows, ReliefPatchesUseTheCoarsestLevelWithNoLargerError) {
    pack::PackOutline outline;
    for (const float error : {4e-3F, 2e-3F, 1e-3F}) {
        outline.levels.emplace_back().error.mean_box = error;
    }
    scene::ScenePlan plan;
    plan.reliefs.resize(2);
    plan.reliefs[0].texels = 64;
    plan.reliefs[0].error.mean_box = 2.5e-3F;
    plan.reliefs[1].texels = 256;
    plan.reliefs[1].error.mean_box = 1e-4F;
    EXPECT_EQ(level_for(outline, plan, {.level = 64, .relief = true}), 1U);
    EXPECT_EQ(level_for(outline, plan, {.level = 256, .relief = true}), 2U) << "the finest there is";
    EXPECT_EQ(level_for(outline, plan, {.level = 0}), 0U);
}

} // namespace
} // namespace frustumscreen::show
