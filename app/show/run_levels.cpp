#include "app/show/run_levels.h"

#include "app/geometry/time_curves.h"
#include "app/render/read_back.h"
#include "firmware_host/base/quantile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>

namespace frustumscreen {

RunLevels::RunLevels(std::string technique, std::vector<Level> levels, std::vector<Rung> rungs,
                     double deadline_ms, FramePlan plan)
    : technique_(std::move(technique)), levels_(std::move(levels)), rungs_(std::move(rungs)),
      deadline_ms_(deadline_ms), governor_(rungs_, std::vector<RungTime>(rungs_.size()), deadline_ms),
      plan_(std::move(plan)) {}

Result<RunLevels> RunLevels::upload(const Pack& pack, const ScenePlan& plan, std::string technique,
                                    double deadline_ms, GpuStore& store) {
    const double mm_per_box = 1e3 * plan.metres_per_box;
    std::vector<Level> levels;
    std::vector<LevelUse> uses;
    std::vector<LeftOut> left_out;
    std::size_t indices = 0;
    RenderNeeds needs;
    for (const std::uint32_t number : plan.levels) {
        const SceneLevel kept = scene_level(pack, number, plan);
        needs = united(needs, needs_of(plan, kept));
        const Image8& texture = pack.textures[kept.mesh.texture];
        for (LeftOut& each : left_out_of(plan, kept, texture)) {
            left_out.push_back(std::move(each));
        }
        const Result<Drawable> drawable = store.upload(kept, texture);
        if (!drawable) {
            for (const Level& each : levels) {
                store.release(each.placed.drawable);
            }
            return tl::unexpected<Error>(drawable.error());
        }
        uses.push_back({number, kept.mesh.indices.size() / 3, kept.unseen_triangles, kept.unseen_clusters,
                        glm::max(glm::ivec2(1), glm::ivec2(texture.width, texture.height) >> kept.finest_mip),
                        kept.finest_mip, gpu_bytes(kept, texture), store.bytes(*drawable)});
        PlacedLevel placed{std::make_shared<LevelTriangles>(triangles_of(kept.mesh, pack.box_size)),
                           pack.box_size,
                           plan.metres_per_box,
                           *drawable,
                           pack.samples,
                           plan.faces};
        levels.push_back({number, fmt::format("level{}", number),
                          mm_per_box * static_cast<double>(kept.mesh.error.mean_box),
                          mm_per_box * static_cast<double>(kept.mesh.error.p95_box), std::move(placed)});
        indices += kept.mesh.indices.size();
    }
    RunLevels made(std::move(technique), std::move(levels), plan.rungs, deadline_ms,
                   make_plan(plan.prop, indices, 2));
    made.uses_ = std::move(uses);
    made.left_out_ = std::move(left_out);
    made.needs_ = needs;
    return made;
}

void RunLevels::release(GpuStore& store) {
    for (const Level& level : levels_) {
        store.release(level.placed.drawable);
    }
}

bool RunLevels::fades() const {
    return std::any_of(rungs_.begin(), rungs_.end(),
                       [&](const Rung& rung) { return rung.level != rungs_.front().level; });
}

std::size_t RunLevels::slot_of(std::uint32_t level) const {
    return static_cast<std::size_t>(
        std::find_if(levels_.begin(), levels_.end(), [&](const Level& l) { return l.level == level; }) -
        levels_.begin());
}

FrameWork RunLevels::work(int samples) const {
    const double more = static_cast<double>(plan_.samples) / samples; // a slanting view takes more
    return {static_cast<double>(plan_.indices.size()) / 3.0, static_cast<double>(plan_.lit.pixels()) * more};
}

double RunLevels::median_ms(const Rung& rung, const PropShape& prop, const PlanView& view, Renderer& renderer,
                            const RenderTarget& target) {
    const Level& level = levels_[slot_of(rung.level)];
    PlacedLevel placed = level.placed;
    placed.samples = rung.samples;
    std::array<double, 7> ms{};
    for (double& each : ms) {
        const auto start = std::chrono::steady_clock::now();
        plan_frame(prop, placed, view, plan_);
        renderer.draw(plan_, target, Redraw::Everything);
        wait_until_drawn();
        each = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    }
    // The first two warm up: shaders are compiled, buffers come into the GPU's memory.
    return quantile_in(std::span(ms).subspan(2), 0.5);
}

void RunLevels::measure(const PropShape& prop, const PlanView& view, Renderer& renderer,
                        const RenderTarget& target) {
    if (rungs_.size() < 2) {
        return;
    }
    std::vector<RungTime> times;
    for (const Rung& rung : rungs_) {
        const double ms = median_ms(rung, prop, view, renderer, target);
        times.push_back({rung.samples, work(rung.samples), ms});
    }
    if (fades()) { // the driver makes the fade's shaders now and not in the middle of the first one
        plan_frame(prop, fade(levels_[0].placed, levels_[1].placed, 0.5), view, plan_);
        renderer.draw(plan_, target, Redraw::Everything);
        wait_until_drawn();
    }
    start(times);
}

void RunLevels::start(const std::vector<RungTime>& times) {
    governor_ = Governor(rungs_, times, deadline_ms_);
    shown_ = slot_of(governor_.rung().level);
}

void RunLevels::enter(MonotonicTime now, double load) {
    governor_.enter(now, load);
    shown_ = slot_of(governor_.rung().level);
    coming_.reset();
}

PlacedLevel RunLevels::placed(std::size_t slot) const {
    PlacedLevel placed = levels_[slot].placed;
    placed.samples = governor_.rung().samples;
    return placed;
}

DrawResult RunLevels::draw(MonotonicTime now, const PropShape& prop, const PlanView& view, Renderer& renderer,
                           const RenderTarget& target, Redraw redraw) {
    const double share = coming_ ? ramp(to_seconds(now - fade_start_), level_fade_s) : 0.0;
    if (share >= 1.0) {
        shown_ = *coming_;
        coming_.reset();
    }
    if (coming_) {
        plan_frame(prop, fade(placed(shown_), placed(*coming_), share), view, plan_);
    } else {
        plan_frame(prop, placed(shown_), view, plan_);
    }
    return renderer.draw(plan_, target, redraw);
}

void RunLevels::record_time(MonotonicTime now, double ms) {
    if (coming_ || plan_.faces.empty()) {
        return; // two levels, or nothing, were drawn: the time says little about one
    }
    governor_.observe(now, work(governor_.rung().samples), ms);
    if (const std::size_t slot = slot_of(governor_.rung().level); slot != shown_) {
        coming_ = slot;
        fade_start_ = now;
    }
}

LevelState RunLevels::state() const {
    const Level& to = levels_[coming_.value_or(shown_)];
    const Level& from = levels_[shown_];
    return {technique_,
            to.name,
            governor_.rung().samples,
            std::max(from.mean_error_mm, to.mean_error_mm),
            std::max(from.p95_error_mm, to.p95_error_mm),
            governor_.switches(),
            governor_.ignored()};
}

} // namespace frustumscreen
