#include "app/residency/run_levels.h"

#include "app/geometry/time_curves.h"
#include "app/render/block_upload.h"
#include "app/render/read_back.h"
#include "firmware_host/base/quantile.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <utility>

namespace frustumscreen {

namespace {

/// Literals, because reports keep the names longer than a level exists. A pack has no more levels than this
/// (app/pack/container/limits.h).
constexpr std::array<std::string_view, 32> level_names{
    "level0",  "level1",  "level2",  "level3",  "level4",  "level5",  "level6",  "level7",
    "level8",  "level9",  "level10", "level11", "level12", "level13", "level14", "level15",
    "level16", "level17", "level18", "level19", "level20", "level21", "level22", "level23",
    "level24", "level25", "level26", "level27", "level28", "level29", "level30", "level31"};

/// Limit for each of the two measurements of a quality level. The start waits for them, and slow frames need
/// few samples, because the governor continues to learn.
constexpr double longest_measurement_ms = 50.0;

/// The bake's resolutions, for both ways of drawing; other resolutions are named without a number here.
struct ReliefName {
    std::uint32_t texels;
    std::string_view raster, on_gpu;
};
constexpr std::array relief_names{
    ReliefName{96, "relief96", "relief96-gpu"},       ReliefName{192, "relief192", "relief192-gpu"},
    ReliefName{384, "relief384", "relief384-gpu"},    ReliefName{768, "relief768", "relief768-gpu"},
    ReliefName{1536, "relief1536", "relief1536-gpu"}, ReliefName{3072, "relief3072", "relief3072-gpu"}};

std::string_view literal_of(const QualityLevel& quality_level) {
    if (!quality_level.relief) {
        return level_names.at(quality_level.level);
    }
    const auto* const found = std::find_if(relief_names.begin(), relief_names.end(), [&](const auto& name) {
        return name.texels == quality_level.level;
    });
    if (found == relief_names.end()) {
        return quality_level.on_gpu ? "relief-gpu" : "relief";
    }
    return quality_level.on_gpu ? found->on_gpu : found->raster;
}

} // namespace

PreparedLevel prepare_level(const Pack& pack, std::uint32_t level, const ScenePlan& plan) {
    const SceneLevel kept = scene_level(pack, level, plan);
    const Image8& texture = pack.textures[kept.mesh.texture];
    PreparedLevel made;
    made.use = {level,
                kept.mesh.indices.size() / 3,
                kept.unseen_triangles,
                kept.unseen_clusters,
                glm::max(glm::ivec2(1), glm::ivec2(texture.width, texture.height) >> kept.finest_mip),
                kept.finest_mip,
                gpu_bytes(kept, texture),
                0};
    made.seen = plan.seen[level];
    made.box_size = pack.box_size;
    made.samples = pack.samples;
    made.triangles = std::make_shared<LevelTriangles>(triangles_of(kept.mesh, pack.box_size));
    made.needs = needs_of(plan, kept);
    made.left_out = left_out_of(plan, kept, texture);
    made.data = level_data(kept, texture);
    return made;
}

bool draws_relief(const ScenePlan& plan, std::size_t place, bool on_gpu) {
    const QualityLevel shown{plan.reliefs[place].texels, 1, false, true, on_gpu};
    return std::any_of(plan.quality_levels.begin(), plan.quality_levels.end(),
                       [&](const QualityLevel& quality_level) { return quality_level.shows_as(shown); });
}

PreparedLevel prepare_relief(const PackDescription& pack, std::size_t place,
                             std::shared_ptr<const BlockRelief> relief, bool on_gpu, const ScenePlan& plan) {
    PreparedLevel made;
    made.use.level = plan.reliefs[place].texels;
    made.use.blocks = relief->blocks.size();
    made.use.on_gpu = on_gpu;
    made.use.planned_gpu_bytes = on_gpu ? gpu_bytes(*relief) : 0;
    made.seen = plan.seen_reliefs[place];
    made.box_size = pack.box_size;
    made.samples = pack.samples;
    made.needs = plan.needs;
    made.data.relief = std::move(relief);
    made.data.on_gpu = on_gpu;
    return made;
}

RunLevels::RunLevels(std::string technique, const ScenePlan& plan, double deadline_ms,
                     std::span<const PreparedLevel> levels)
    : technique_(std::move(technique)), quality_levels_(plan.quality_levels), deadline_ms_(deadline_ms),
      governor_(quality_levels_, std::vector<QualityLevelTime>(quality_levels_.size()), deadline_ms) {
    std::size_t indices = 0;
    for (const PreparedLevel& level : levels) {
        uses_.push_back(level.use);
        left_out_.insert(left_out_.end(), level.left_out.begin(), level.left_out.end());
        needs_ = united(needs_, level.needs);
        indices += level.triangles ? level.triangles->indices.size() : 0;
        levels_.push_back(
            {QualityLevel{level.use.level, 1, false, level.data.relief != nullptr, level.data.on_gpu},
             level.seen,
             PlacedLevel{level.triangles,
                         level.box_size,
                         plan.metres_per_box,
                         {},
                         level.samples,
                         plan.faces,
                         level.data.relief,
                         level.data.on_gpu}});
    }
    plan_ = make_plan(plan.prop, indices, 2);
}

void RunLevels::give(std::size_t place, const Drawable& drawable, const GpuStore& store) {
    levels_[place].placed.drawable = drawable;
    uses_[place].gpu_bytes = store.bytes(drawable);
}

Result<RunLevels> RunLevels::upload(const Pack& pack, const ScenePlan& plan, std::string technique,
                                    double deadline_ms, GpuStore& store) {
    std::vector<PreparedLevel> prepared;
    for (const std::uint32_t level : plan.levels) {
        prepared.push_back(prepare_level(pack, level, plan));
    }
    RunLevels made(std::move(technique), plan, deadline_ms, prepared);
    for (std::size_t place = 0; place < prepared.size(); ++place) {
        LevelUpload upload(std::move(prepared[place].data));
        if (Result<void> done = upload.go_on(); !done) {
            made.release(store);
            return tl::unexpected<Error>(done.error());
        }
        made.give(place, store.keep(std::move(upload)), store);
    }
    return made;
}

void RunLevels::release(GpuStore& store) {
    for (const Level& level : levels_) {
        store.release(level.placed.drawable);
    }
}

std::uint64_t RunLevels::bytes() const {
    std::uint64_t bytes = 0;
    std::uint64_t max_indices = 0;
    for (std::size_t place = 0; place < levels_.size(); ++place) {
        const PlacedLevel& placed = levels_[place].placed;
        bytes += uses_[place].planned_gpu_bytes;
        if (placed.relief) {
            const bool counted = place > 0 && levels_[place - 1].placed.relief == placed.relief;
            bytes += counted ? 0 : bytes_of(*placed.relief); // both ways of drawing share the relief
            continue;
        }
        bytes += bytes_of(*placed.triangles);
        max_indices = std::max<std::uint64_t>(max_indices, placed.triangles->indices.size());
    }
    // The plan of a frame lists the triangles that face the eye, and those that a face shows.
    return bytes + 2 * sizeof(std::uint32_t) * max_indices;
}

std::size_t RunLevels::slot_of(const QualityLevel& quality_level) const {
    return static_cast<std::size_t>(
        std::find_if(levels_.begin(), levels_.end(),
                     [&](const Level& l) { return l.shows.shows_as(quality_level); }) -
        levels_.begin());
}

FrameWork RunLevels::work(const QualityLevel& quality_level) const {
    const auto pixels = static_cast<double>(plan_.lit.pixels());
    const auto more = [&](int samples) {
        return pixels * samples / quality_level.samples;
    }; // a slanting view takes more samples
    if (quality_level.relief) {
        const BlockRelief& relief = *levels_[slot_of(quality_level)].placed.relief;
        return {static_cast<double>(relief.blocks.size()), quality_level.on_gpu ? more(plan_.samples)
                                                           : plan_.relief_draw_count > 0
                                                               ? more(plan_.relief_draws[0].samples)
                                                               : pixels};
    }
    return {static_cast<double>(plan_.indices.size()) / 3.0, more(plan_.samples)};
}

double RunLevels::median_ms(const QualityLevel& quality_level, const PropShape& prop, const PlanView& view,
                            Renderer& renderer, const RenderTarget& target) {
    const Level& level = levels_[slot_of(quality_level)];
    PlacedLevel placed = level.placed;
    placed.samples = quality_level.samples;
    std::array<double, 7> ms{};
    std::size_t drawn = 0;
    double spent_ms = 0.0;
    while (drawn < 2 || (drawn < ms.size() && spent_ms < longest_measurement_ms)) {
        const auto start = std::chrono::steady_clock::now();
        plan_frame(prop, placed, view, plan_);
        renderer.draw(plan_, target, Redraw::Everything);
        wait_until_drawn();
        ms[drawn] =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        spent_ms += ms[drawn++];
    }
    // The first two frames (of only two, the first) are warm-up: shaders are compiled and buffers move to the
    // GPU's memory.
    return quantile_in(std::span(ms).first(drawn).subspan(std::min<std::size_t>(2, drawn - 1)), 0.5);
}

void RunLevels::measure(const PropShape& prop, const PlanView& view, Renderer& renderer,
                        const RenderTarget& target) {
    std::vector<QualityLevelTime> times(quality_levels_.size());
    for (std::size_t k = 0; k < quality_levels_.size(); ++k) {
        const double ms = median_ms(quality_levels_[k], prop, view, renderer, target);
        times[k] = {quality_levels_[k].samples, work(quality_levels_[k]), ms, quality_levels_[k].relief,
                    quality_levels_[k].on_gpu};
    }
    // Repeat in reverse order: other load on the machine may have slowed some levels and not others. Levels
    // whose frames are slow are not measured again, to keep the start short.
    for (std::size_t k = quality_levels_.size(); k-- > 0;) {
        if (2.0 * times[k].ms < longest_measurement_ms) {
            times[k].ms = std::min(times[k].ms, median_ms(quality_levels_[k], prop, view, renderer, target));
        }
    }
    // The driver compiles its own programs at the first draw with a shader. Draw with each now, rather than
    // in the middle of a fade or at the first artifact with cut-out texels.
    for (const ShaderKey& key : renderer.shaders()) {
        const bool is_raster = key.pass == ShaderKey::Pass::Raster;
        const auto level = std::find_if(levels_.begin(), levels_.end(), [&](const Level& one) {
            return one.shows.relief == (is_raster || key.blocks) && one.shows.on_gpu == key.blocks;
        });
        if ((is_raster || key.pass == ShaderKey::Pass::Surface) && !key.places &&
            (is_raster || key.even_light == view.light.has_value()) && level != levels_.end()) {
            PlacedLevel placed = level->placed;
            placed.drawable.material.cut_out = key.cut_out;
            if (key.dithered) {
                plan_frame(prop, fade(placed, placed, 0.5), view, plan_);
            } else {
                plan_frame(prop, placed, view, plan_);
            }
            renderer.draw(plan_, target, Redraw::Everything);
        }
    }
    wait_until_drawn();
    start(times);
}

void RunLevels::start(const FrameCost& cost, const PropShape& prop, const PlanView& view) {
    std::vector<QualityLevelTime> times;
    for (const QualityLevel& quality_level : quality_levels_) {
        PlacedLevel placed = levels_[slot_of(quality_level)].placed;
        placed.samples = quality_level.samples;
        plan_frame(prop, placed, view, plan_);
        times.push_back(
            {quality_level.samples, work(quality_level), 0.0, quality_level.relief, quality_level.on_gpu});
        times.back().ms = cost.ms(times.back());
    }
    start(times);
}

void RunLevels::start(const std::vector<QualityLevelTime>& times) {
    times_ = times;
    governor_ = Governor(quality_levels_, times, deadline_ms_);
    shown_ = slot_of(governor_.quality_level());
}

void RunLevels::enter(MonotonicTime now, double load) {
    governor_.enter(now, load);
    shown_ = slot_of(governor_.quality_level());
    coming_.reset();
}

PlacedLevel RunLevels::placed(std::size_t slot) const {
    PlacedLevel placed = levels_[slot].placed;
    placed.samples = governor_.quality_level().samples;
    return placed;
}

std::optional<ErrorEstimate> RunLevels::estimate(const PropShape& prop, const PlanView& view) const {
    const auto of = [&](std::size_t slot) {
        return estimate_error(levels_[slot].seen, prop, levels_[slot].placed, view, plan_);
    };
    const std::optional<ErrorEstimate> shown = of(shown_);
    const std::optional<ErrorEstimate> coming = coming_ ? of(*coming_) : shown;
    return shown ? std::optional(ErrorEstimate{std::fmax(shown->mean_mm, coming->mean_mm),
                                               std::fmax(shown->p95_mm, coming->p95_mm)})
                 : std::nullopt;
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
    const DrawResult result = renderer.draw(plan_, target, redraw);
    if (result.drawn) { // otherwise the earlier picture and its error stay
        error_ = estimate(prop, view);
    }
    return result;
}

void RunLevels::record_time(MonotonicTime now, double ms) {
    if (coming_ || plan_.faces.empty()) {
        return; // two levels, or none, were drawn: the time does not tell about one level
    }
    governor_.observe(now, work(governor_.quality_level()), ms);
    if (const std::size_t slot = slot_of(governor_.quality_level()); slot != shown_) {
        coming_ = slot;
        fade_start_ = now;
    }
}

LevelState RunLevels::state() const {
    const Level& to = levels_[coming_.value_or(shown_)];
    return {technique_, literal_of(to.shows), governor_.quality_level().samples,
            error_,     governor_.switches(), governor_.ignored()};
}

} // namespace frustumscreen
