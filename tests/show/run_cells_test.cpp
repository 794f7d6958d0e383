// The cells of an artifact in memory and on the display.

#include "app/pack/pack_world.h"
#include "app/render/read_back.h"
#include "app/residency/loaded.h"
#include "firmware_host/display/surfaceless_display.h"
#include "tests/render/counted_new.h"
#include "tests/show/shown_packs.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <vector>

namespace frustumscreen::synthetic {
namespace {

using std::chrono::milliseconds;

/// Slides the first cell for a second; with `stays` it remains there.
world::Behaviour slide(bool stays) {
    world::Behaviour behaviour;
    behaviour.name = "slide";
    behaviour.seconds = 1.0;
    behaviour.stays = stays;
    behaviour.channels = {{.cell = 0,
                           .path = world::Path::Translation,
                           .curve = {.interpolation = world::Interpolation::Linear,
                                     .times_s = {0.0F, 1.0F},
                                     .values = {glm::vec4(0.0F), glm::vec4(0.05F, 0.02F, 0.0F, 0.0F)}}}};
    return behaviour;
}

/// Rings whose cells are rings in the same place: `cells` of them, so that one cell shows what the whole shows.
pack::Pack pack_of_cells(std::size_t cells, const std::vector<world::Behaviour>& behaviours,
                         bool drawn_at_rest = false) {
    pack::Pack whole = numbered_pack(0);
    pack::PackWorld world;
    world.drawn_at_rest = drawn_at_rest;
    std::vector<pack::Pack> geometry;
    for (std::size_t k = 0; k < cells; ++k) {
        geometry.push_back(numbered_pack(0));
        pack::PackCell& cell = world.cells.emplace_back();
        cell.cell.name = fmt::format("rings {}", k);
        cell.cell.has_geometry = true;
        cell.triangles = 1728;
        cell.low = {-0.5 * whole.box_size.x, -0.5 * whole.box_size.y, 0.0};
        cell.high = {0.5 * whole.box_size.x, 0.5 * whole.box_size.y, whole.box_size.z};
    }
    for (const world::Behaviour& behaviour : behaviours) {
        world.behaviours.push_back({behaviour, {}});
    }
    const Result<void> put = pack::put_world(whole, world, geometry);
    EXPECT_TRUE(put) << put.error().message;
    return whole;
}

class CellsOnShow : public testing::Test {
protected:
    void load(const pack::Pack& pack, const std::string& technique) {
        ASSERT_TRUE(write_file(file_, pack::write_pack(pack).value()));
        scene::SceneRequest request;
        request.technique = technique;
        request.light = false;
        request.cull_kinds = scene::AllCullKinds & ~static_cast<unsigned>(scene::UnseenTriangles);
        const settings::Settings settings = settings::steep_table();
        known_ = {.file = file_, .outline = pack::outline_of(*pack::load_pack(file_).value()), .plan = {}};
        known_.plan = scene::plan_scene(settings, known_.outline, request).value();
        known_.world =
            residency::open_world(settings, file_, known_.outline.description, known_.plan, request).value();
        Result<residency::PreparedArtifact> prepared =
            residency::prepare_artifact(known_, technique, deadline_ms, [] { return false; });
        ASSERT_TRUE(prepared) << prepared.error().message;
        loaded_ = std::make_unique<residency::LoadedLevels>(*std::move(prepared));
    }
    void upload() {
        ASSERT_TRUE(renderer_.prepare(residency::needs_of(*known_.world, known_.plan.needs)));
        before_bytes_ = renderer_.store().bytes();
        while (!loaded_->ready()) {
            ASSERT_TRUE(loaded_->upload(renderer_.store(), 10'000));
        }
        const scene::PlanView view = table_.view();
        levels().measure(table_.prop, std::span(&view, 1), renderer_, {display_->framebuffer(), 0});
    }
    [[nodiscard]] residency::RunLevels& levels() { return loaded_->artifact.levels; }
    [[nodiscard]] residency::RunCells& cells() { return *loaded_->artifact.cells; }
    /// As ArtifactShow.
    render::DrawResult draw() {
        now_ += milliseconds(20);
        const scene::PlanView view = table_.view();
        const render::RenderTarget target{display_->framebuffer(), display_->buffer_age()};
        const render::DrawResult drawn =
            cells().step(now_, 1.0) ? cells().draw(now_, levels().shown(), table_.prop, std::span(&view, 1),
                                                   renderer_, target, render::Redraw::Changes)
                                    : levels().draw(now_, table_.prop, std::span(&view, 1), renderer_, target,
                                                    render::Redraw::Changes);
        if (drawn.drawn) {
            EXPECT_TRUE(display_->present(now_));
        }
        return drawn;
    }
    image::Image8 picture() {
        draw();
        return render::read_colour(display_->framebuffer(), 320, 200);
    }

    static constexpr double deadline_ms = 16.0;
    TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.path() / "rings.fspack";
    TestTable table_{320, 200};
    std::unique_ptr<display::SurfacelessDisplay> display_ =
        display::SurfacelessDisplay::create(320, 200).value();
    render::Renderer renderer_ = render::Renderer::create(320, 200).value();
    residency::KnownArtifact known_;
    std::unique_ptr<residency::LoadedLevels> loaded_;
    std::uint64_t before_bytes_ = 0;
    MonotonicTime now_;
};

TEST_F(CellsOnShow, ReplaceTheWholeWhileTheyMove) {
    load(pack_of_cells(1, {slide(false)}), "level1");
    upload();
    const image::Image8 whole = picture();
    EXPECT_FALSE(cells().shows());
    cells().player().trigger(0, now_);
    int moved = 0;
    int at_rest = 0;
    for (int frame = 0; frame < 200; ++frame) {
        const image::Image8 now = picture();
        if (!cells().shows()) {
            EXPECT_EQ(now.texels, whole.texels) << frame;
        } else if (cells().player().moves()) {
            moved += now.texels != whole.texels ? 1 : 0;
        } else { // the cells are at rest, and fade to the whole, which looks the same
            EXPECT_EQ(now.texels, whole.texels) << frame;
            ++at_rest;
        }
    }
    EXPECT_GT(moved, 50); // a second, and the way back
    EXPECT_NEAR(at_rest, residency::level_fade_s / 0.02, 2.0);
    EXPECT_FALSE(cells().shows());
    ASSERT_TRUE(cells().error());
    EXPECT_GT(cells().error()->mean_mm, 0.0);
}

TEST_F(CellsOnShow, AreDrawnAtRestIfThePackSaysSo) {
    load(pack_of_cells(1, {}, true), "auto");
    ASSERT_NE(known_.world, nullptr);
    upload();
    const image::Image8 first = picture();
    EXPECT_TRUE(cells().shows());
    EXPECT_FALSE(cells().fades());
    ASSERT_TRUE(cells().error());
    EXPECT_TRUE(std::any_of(first.texels.begin(), first.texels.end(),
                            [](const glm::u8vec4& texel) { return texel.r > 0; }));
    for (int frame = 0; frame < 50; ++frame) {
        EXPECT_FALSE(draw().drawn) << "nothing moves";
        EXPECT_TRUE(cells().shows());
    }
}

TEST_F(CellsOnShow, AtRestAreNotLoadedForAFixedTechnique) {
    load(pack_of_cells(1, {}, true), "level1");
    EXPECT_EQ(known_.world, nullptr);
    load(pack_of_cells(1, {}), "auto");
    EXPECT_EQ(known_.world, nullptr) << "nothing moves, and the whole is quicker";
}

TEST_F(CellsOnShow, AreRedrawnOnlyWhileTheyMove) {
    load(pack_of_cells(1, {slide(true)}), "level1");
    upload();
    draw();
    EXPECT_FALSE(draw().drawn);
    cells().player().trigger(0, now_);
    int drawn = 0;
    for (int frame = 0; frame < 50; ++frame) {
        drawn += draw().drawn ? 1 : 0;
    }
    EXPECT_GE(drawn, 48);
    draw();
    for (int frame = 0; frame < 20; ++frame) { // it stays where it is
        EXPECT_FALSE(draw().drawn) << frame;
        EXPECT_TRUE(cells().shows());
    }
}

TEST_F(CellsOnShow, DrawingAllocatesNothing) {
    if (!allocations_are_counted) {
        GTEST_SKIP() << "allocations are not counted under a sanitizer";
    }
    load(pack_of_cells(2, {slide(false)}), "level1");
    upload();
    draw();
    cells().player().trigger(0, now_);
    draw();
    const long before = allocations_so_far();
    int shown = 0;
    for (int frame = 0; frame < 150; ++frame) {
        draw();
        cells().record_time(now_, 5.0);
        shown += cells().shows() ? 1 : 0;
    }
    EXPECT_EQ(allocations_so_far() - before, 0);
    EXPECT_GT(shown, 50);
}

TEST_F(CellsOnShow, AreCountedAndReleasedWithTheirArtifact) {
    load(pack_of_cells(2, {slide(false)}), "level1");
    EXPECT_EQ(loaded_->bytes(), levels().bytes() + cells().bytes());
    EXPECT_GT(cells().bytes(), levels().bytes()); // two of them
    upload();
    std::uint64_t planned = 0;
    for (const auto* const uses : {&levels().uses(), &cells().uses()}) {
        for (const residency::LevelUse& use : *uses) {
            planned += use.planned_gpu_bytes;
            EXPECT_EQ(use.planned_gpu_bytes, use.gpu_bytes);
        }
    }
    EXPECT_EQ(renderer_.store().bytes() - before_bytes_, planned);
    loaded_->release(renderer_.store());
    EXPECT_EQ(renderer_.store().bytes(), before_bytes_);
}

/// The finer level of both cells takes twice the deadline, the coarser one a third.
TEST_F(CellsOnShow, AreDrawnCoarserWhenTimeIsShort) {
    load(pack_of_cells(2, {slide(true)}), "auto");
    ASSERT_EQ(cells().uses().size(), 4U) << "two levels of each cell";
    upload();
    const auto triangles_drawn = [&](double ms_per_triangle) {
        scene::FrameCost cost;
        cost.mesh.ms_per_triangle = ms_per_triangle;
        cells().start(cost);
        cells().player().start(0, now_);
        for (int frame = 0; frame < 100; ++frame) {
            draw();
        }
        return cells().plans().front().indices.size() / 3;
    };
    const std::size_t fine = triangles_drawn(0.0);
    const std::size_t coarse = triangles_drawn(deadline_ms / 864.0);
    EXPECT_LT(coarse, fine / 2);
    EXPECT_GE(cells().switches(), 1U);
}

TEST_F(CellsOnShow, AreNotLoadedForAnArtifactThatNeverMoves) {
    load(pack_of_cells(2, {}), "level1");
    const pack::Pack plain = numbered_pack(0);
    EXPECT_EQ(known_.world, nullptr);
    EXPECT_EQ(loaded_->artifact.cells, nullptr);
    EXPECT_EQ(loaded_->bytes(), levels().bytes());
    const std::uint64_t bytes = loaded_->bytes();
    load(plain, "level1");
    EXPECT_EQ(known_.world, nullptr);
    EXPECT_EQ(loaded_->artifact.cells, nullptr);
    EXPECT_EQ(loaded_->bytes(), bytes);
}

} // namespace
} // namespace frustumscreen::synthetic
