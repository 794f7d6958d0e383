// An artifact's levels on the display, with frame times invented by the test.

#include "app/render/read_back.h"
#include "app/residency/run_levels.h"
#include "firmware_host/display/surfaceless_display.h"
#include "tests/render/counted_new.h"
#include "tests/render/synthetic_pack.h"
#include "tests/settings/steep_table.h"

#include <gtest/gtest.h>

#include <cmath>

namespace frustumscreen::synthetic {
namespace {

/// Rings at two levels: the coarse points are points of the fine level, so the box is the same.
pack::Pack two_levels() {
    pack::Pack pack = rings(24, 12);
    const pack::Pack coarse = rings(12, 4);
    pack.levels.insert(pack.levels.begin(), coarse.levels[0]);
    pack.levels[0].error = {4e-3F, 2e-2F, 4e-2F, 0.0F};
    pack.levels[1].error = {3e-4F, 1e-3F, 4e-3F, 0.0F};
    for (unsigned k = 0; k < 8; ++k) {
        pack.extremes.emplace_back(((k & 1U) != 0 ? 0.5 : -0.5) * pack.box_size.x,
                                   ((k & 2U) != 0 ? 0.5 : -0.5) * pack.box_size.y,
                                   (k & 4U) != 0 ? pack.box_size.z : 0.0);
    }
    pack.samples = 1;
    return pack;
}

constexpr double deadline_ms = 16.0;
/// A GPU that takes 9 ms for the fine level and 3 ms for the coarse one.
const std::vector<scene::QualityLevelTime> gpu_times{{1, {1728.0, 20000.0}, 9.0}, {1, {288.0, 20000.0}, 3.0}};

struct Show {
    pack::Pack pack = two_levels();
    TestTable table{320, 200};
    std::unique_ptr<display::SurfacelessDisplay> display =
        display::SurfacelessDisplay::create(320, 200).value();
    render::Renderer renderer = render::Renderer::create(320, 200).value();
    int frame = 0;

    [[nodiscard]] Result<residency::RunLevels> upload(const std::string& technique,
                                                      double tolerance_mm = 0.28) {
        settings::Settings settings = settings::steep_table();
        const double pixel_m = scene::pixel_on_prop_m(table.prop, settings.projector.pinhole,
                                                      settings.projector.table_from_projector.inverse());
        settings.render.error_tolerance_px = 1e-3 * tolerance_mm / pixel_m;
        scene::SceneRequest request;
        request.technique = technique;
        request.light = false;
        TRY(const scene::ScenePlan plan, scene::plan_scene(settings, pack::outline_of(pack), request));
        Result<residency::RunLevels> made =
            residency::RunLevels::upload(pack, plan, technique, deadline_ms, renderer.store());
        if (made) {
            EXPECT_TRUE(renderer.prepare(made->needs()));
        }
        return made;
    }
    [[nodiscard]] residency::RunLevels levels(const std::string& technique) {
        residency::RunLevels made = upload(technique).value();
        const scene::PlanView view = table.view();
        made.measure(table.prop, std::span(&view, 1), renderer, {display->framebuffer(), 0});
        if (made.uses().size() > 1) {
            made.start(gpu_times); // independent of this machine's speed
        }
        return made;
    }
    [[nodiscard]] MonotonicTime now() const { return MonotonicTime(std::chrono::milliseconds(20) * frame); }
    render::DrawResult draw(residency::RunLevels& levels) {
        ++frame;
        const scene::PlanView view = table.view();
        const render::DrawResult drawn =
            levels.draw(now(), table.prop, std::span(&view, 1), renderer,
                        {display->framebuffer(), display->buffer_age()}, render::Redraw::Changes);
        EXPECT_TRUE(display->present(now()));
        return drawn;
    }
    image::Image8 picture(residency::RunLevels& levels) {
        draw(levels);
        return render::read_colour(display->framebuffer(), 320, 200);
    }
    /// Draws frames of `ms` each, with a prop that moves slightly from frame to frame.
    void play(residency::RunLevels& levels, int frames, double ms) {
        for (int k = 0; k < frames; ++k) {
            table.table_from_prop.translation.x = 1e-4 * (frame % 2);
            draw(levels);
            levels.record_time(now(), ms);
        }
    }
};

TEST(RunLevels, DrawTheCheapestLevelWithinTheTolerance) {
    Show show;
    residency::RunLevels levels = show.levels("auto");
    EXPECT_EQ(levels.uses().size(), 2U);
    show.play(levels, 100, 9.0);
    EXPECT_EQ(levels.state().level, "level1");
    EXPECT_EQ(levels.state().technique, "auto");
    EXPECT_EQ(levels.state().switches, 0U);
    const double mm_per_box = 1e3 * pack::place(show.pack, show.table.prop).metres_per_box;
    ASSERT_TRUE(levels.state().error);
    EXPECT_NEAR(levels.state().error->mean_mm, 6e-4 * mm_per_box,
                5e-5 * mm_per_box); // along the rays, plus pixel rounding
    EXPECT_GT(levels.state().error->p95_mm, 2e-3 * mm_per_box);
    show.table.table_from_prop.translation.x = 3.0; // beside the picture
    show.draw(levels);
    EXPECT_FALSE(levels.state().error);
    // All levels are within a tolerance of 10 mm: the finer one is not even loaded.
    const residency::RunLevels coarse = show.upload("auto", 10.0).value();
    EXPECT_EQ(coarse.uses().size(), 1U);
    EXPECT_EQ(coarse.state().level, "level0");
}

TEST(RunLevels, FadeToACoarserLevelWhenTheDeadlineIsMissed) {
    Show show;
    residency::RunLevels coarse = show.levels("level0");
    residency::RunLevels fine = show.levels("level1");
    residency::RunLevels levels = show.levels("auto");
    show.play(levels, 20, 9.0);
    int frames = 0;
    for (; levels.state().level == "level1" && frames < 500; ++frames) {
        show.play(levels, 1, 1.5 * deadline_ms);
    }
    ASSERT_GT(frames, 10);
    ASSERT_LT(frames, 100); // two seconds of the test's clock
    // At rest in the middle of the fade: the fade continues by itself and ends at the coarse level.
    const int start = show.frame;
    const image::Image8 to = show.picture(coarse);
    const image::Image8 from = show.picture(fine);
    show.frame = start;
    EXPECT_TRUE(levels.fades());
    std::size_t last_coming = 0;
    const int fade_frames = static_cast<int>(std::lround(residency::level_fade_s / 0.02));
    for (int k = 1; k <= fade_frames; ++k) {
        const image::Image8 middle = show.picture(levels);
        std::size_t coming = 0;
        for (std::size_t p = 0; p < middle.texels.size(); ++p) {
            ASSERT_TRUE(middle.texels[p] == from.texels[p] || middle.texels[p] == to.texels[p]) << k;
            coming += from.texels[p] != to.texels[p] && middle.texels[p] == to.texels[p] ? 1U : 0U;
        }
        EXPECT_GE(coming, last_coming) << k;
        last_coming = coming;
        levels.record_time(show.now(), 9.0); // a frame of two levels is ignored by the governor
    }
    EXPECT_EQ(show.picture(levels).texels, to.texels);
    EXPECT_FALSE(levels.fades());
    EXPECT_EQ(levels.state().level, "level0");
    EXPECT_EQ(levels.state().switches, 1U);
    EXPECT_FALSE(show.draw(levels).drawn); // at rest again
    // Back to the fine level when frames are fast.
    show.play(levels, 1200, 3.0);
    EXPECT_EQ(levels.state().level, "level1");
    EXPECT_EQ(levels.state().switches, 2U);
}

TEST(RunLevels, FixedTechniqueNeverSwitches) {
    Show show;
    for (const auto& [technique, level] : {std::pair("level0", "level0"), std::pair("finest", "level1")}) {
        residency::RunLevels levels = show.levels(technique);
        EXPECT_EQ(levels.uses().size(), 1U);
        show.play(levels, 200, 50.0 * deadline_ms);
        EXPECT_EQ(levels.state().level, level);
        EXPECT_EQ(levels.state().switches, 0U);
    }
    EXPECT_FALSE(show.upload("level2"));
}

/// The bytes of a texture and its mip levels down to a sixteenth.
std::uint64_t bytes_with_mips(int width, int height) {
    std::uint64_t texels = 0;
    for (int mip = 0; mip <= 4; ++mip) {
        texels += static_cast<std::uint64_t>(width >> mip) * static_cast<std::uint64_t>(height >> mip);
    }
    return 4 * texels;
}

TEST(RunLevels, ShareTheTextureOfTheirPack) {
    Show show;
    const render::GpuStore& store = show.renderer.store();
    std::uint64_t apart = 0;
    image::Image8 coarse_alone;
    for (const std::string technique : {"level1", "level0"}) {
        residency::RunLevels alone = show.levels(technique);
        apart += store.bytes();
        coarse_alone = show.picture(alone);
        alone.release(show.renderer.store());
    }
    residency::RunLevels levels = show.levels("auto");
    const image::Image8& texture = show.pack.textures[0];
    EXPECT_EQ(store.bytes(), apart - bytes_with_mips(texture.width, texture.height));
    std::uint64_t used = 0;
    for (const residency::LevelUse& use : levels.uses()) {
        EXPECT_EQ(use.gpu_bytes, use.planned_gpu_bytes);
        used += use.gpu_bytes;
    }
    EXPECT_EQ(used, store.bytes());

    show.play(levels, 200, 60.0); // until the coarse one is shown
    show.table.table_from_prop.translation.x = 0.0;
    EXPECT_EQ(levels.state().level, "level0");
    EXPECT_EQ(show.picture(levels).texels, coarse_alone.texels);
}

TEST(RunLevels, LeaveNothingInTheStoreAfterReleaseOrFailedUpload) {
    Show show;
    residency::RunLevels levels = show.upload("auto").value();
    EXPECT_EQ(levels.uses().size(), 2U);
    EXPECT_GT(show.renderer.store().bytes(), 0U);
    levels.release(show.renderer.store());
    EXPECT_EQ(show.renderer.store().bytes(), 0U);
    show.pack.levels[0].texture = 1; // uploaded after level 1: wider than any driver takes
    show.pack.textures.emplace_back(100'000, 1);
    EXPECT_FALSE(show.upload("auto"));
    EXPECT_EQ(show.renderer.store().bytes(), 0U);
}

TEST(RunLevels, CountInvalidFrameTimes) {
    Show show;
    residency::RunLevels levels = show.levels("auto");
    show.play(levels, 50, std::nan(""));
    show.play(levels, 50, -1.0);
    EXPECT_EQ(levels.state().ignored_times, 100U);
    EXPECT_EQ(levels.state().level, "level1");
}

TEST(RunLevels, DrawingAllocatesNothing) {
    if (!allocations_are_counted) {
        GTEST_SKIP() << "allocations are not counted under a sanitizer";
    }
    Show show;
    residency::RunLevels levels = show.levels("auto");
    show.play(levels, 30, 9.0);
    show.play(levels, 60, 1.5 * deadline_ms); // the driver meets every state once: fine, fade, coarse
    ASSERT_EQ(levels.state().level, "level0");
    show.play(levels, 400, 3.0);
    ASSERT_EQ(levels.state().level, "level1");
    const long before = allocations_so_far();
    show.play(levels, 200, 1.5 * deadline_ms);
    EXPECT_EQ(levels.state().level, "level0");
    EXPECT_EQ(allocations_so_far() - before, 0);
}

} // namespace
} // namespace frustumscreen::synthetic
