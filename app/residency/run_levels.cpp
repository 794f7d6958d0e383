#include "app/residency/run_levels.h"

#include "app/geometry/time_curves.h"
#include "app/render/read_back.h"
#include "app/scene/torch_plan.h"
#include "firmware_host/base/quantile.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <utility>

namespace frustumscreen::residency {

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
    ReliefName{24, "relief24", "relief24-gpu"},       ReliefName{48, "relief48", "relief48-gpu"},
    ReliefName{96, "relief96", "relief96-gpu"},       ReliefName{192, "relief192", "relief192-gpu"},
    ReliefName{384, "relief384", "relief384-gpu"},    ReliefName{768, "relief768", "relief768-gpu"},
    ReliefName{1536, "relief1536", "relief1536-gpu"}, ReliefName{3072, "relief3072", "relief3072-gpu"}};

/// A level without a fade.
std::array<scene::Part, 1> whole(const scene::PlacedLevel& level) {
    return {scene::Part{level, std::nullopt}};
}

std::string_view literal_of(const scene::QualityLevel& quality_level) {
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

RunLevels::RunLevels(std::string technique, const scene::ScenePlan& plan, double deadline_ms,
                     std::span<const PreparedLevel> levels)
    : technique_(std::move(technique)), quality_levels_(plan.quality_levels), deadline_ms_(deadline_ms),
      governor_(quality_levels_, std::vector<scene::QualityLevelTime>(quality_levels_.size()), deadline_ms) {
    std::array<std::size_t, 2> largest{}; // one fades to the other
    for (const PreparedLevel& level : levels) {
        uses_.push_back(level.use);
        left_out_.insert(left_out_.end(), level.left_out.begin(), level.left_out.end());
        needs_ = scene::united(needs_, level.needs);
        largest.front() = std::max(largest.front(), level.triangles ? level.triangles->indices.size() : 0);
        std::sort(largest.begin(), largest.end());
        levels_.push_back({scene::QualityLevel{.level = level.use.level,
                                               .samples = 1,
                                               .enough = false,
                                               .relief = level.data.relief != nullptr,
                                               .on_gpu = level.data.on_gpu},
                           level.seen,
                           scene::PlacedLevel{.triangles = level.triangles,
                                              .box_size = level.box_size,
                                              .metres_per_box = plan.metres_per_box,
                                              .drawable = {},
                                              .samples = level.samples,
                                              .faces = plan.faces,
                                              .relief = level.data.relief,
                                              .on_gpu = level.data.on_gpu}});
    }
    const std::size_t indices = largest[0] + largest[1];
    constexpr std::size_t max_parts = 2 + max_marks;
    parts_.reserve(max_parts);
    for (std::size_t eye = 0; eye < plan.eyes; ++eye) {
        plans_.push_back(scene::make_plan(plan.prop, indices + max_mark_indices, max_parts));
        if (!plan.needs.torches.empty()) {
            scene::make_torch_space(plans_.back(), plan.prop.faces.size(), indices + max_mark_indices,
                                    max_parts);
        }
    }
}

void RunLevels::give(std::size_t place, const scene::Drawable& drawable, const render::GpuStore& store) {
    levels_[place].placed.drawable = drawable;
    note_gpu_bytes(store, drawable, uses_[place]);
}

Result<void> RunLevels::add_layer(render::GpuStore& store, const ReadLayer& layer) {
    for (std::size_t place = 0; place < levels_.size(); ++place) {
        scene::PlacedLevel& placed = levels_[place].placed;
        TRY_VOID(residency::add_layer(store, layer, uses_[place].level, placed.relief != nullptr,
                                      placed.drawable));
    }
    return {};
}

std::optional<scene::PlacedLevel> RunLevels::in_layer(std::size_t layer) const {
    constexpr double as_exact = 2.0; // times the error
    const auto error = [](const Level& level) {
        return static_cast<double>(scene::worst_of(level.seen).mean_box);
    };
    const auto triangles = [](const Level& level) { return level.placed.triangles->indices.size(); };
    const double allowed = as_exact * error(levels_[shown_]);
    const Level* best = nullptr;
    for (const Level& level : levels_) {
        if (!level.placed.triangles) {
            continue;
        }
        const bool is_exact = error(level) <= allowed;
        const bool best_is_exact = best != nullptr && error(*best) <= allowed;
        if (best == nullptr || (is_exact && !best_is_exact) ||
            (is_exact ? triangles(level) < triangles(*best)
                      : !best_is_exact && error(level) < error(*best))) {
            best = &level;
        }
    }
    if (best == nullptr || best->placed.drawable.layers.at(layer) == scene::TextureId::None) {
        return std::nullopt;
    }
    scene::PlacedLevel placed = best->placed;
    placed.drawable.material.texture = placed.drawable.layers[layer];
    return placed;
}

Result<RunLevels> RunLevels::upload(const pack::Pack& pack, const scene::ScenePlan& plan,
                                    std::string technique, double deadline_ms, render::GpuStore& store) {
    std::vector<PreparedLevel> prepared;
    for (const std::uint32_t level : plan.levels) {
        prepared.push_back(prepare_level(pack, level, plan, prepared));
    }
    RunLevels made(std::move(technique), plan, deadline_ms, prepared);
    for (std::size_t place = 0; place < prepared.size(); ++place) {
        const std::optional<std::size_t> shared = prepared[place].data.texture_of;
        render::LevelUpload upload(std::move(prepared[place].data));
        if (Result<void> done = upload.go_on(); !done) {
            made.release(store);
            return tl::unexpected<Error>(done.error());
        }
        const scene::TextureId texture =
            shared ? made.levels_[*shared].placed.drawable.material.texture : scene::TextureId::None;
        made.give(place, store.keep(std::move(upload), texture), store);
    }
    return made;
}

void RunLevels::release(render::GpuStore& store) {
    for (const Level& level : levels_) {
        store.release(level.placed.drawable);
    }
}

std::uint64_t RunLevels::bytes() const {
    std::uint64_t bytes = 0;
    std::uint64_t max_indices = 0;
    for (std::size_t place = 0; place < levels_.size(); ++place) {
        const scene::PlacedLevel& placed = levels_[place].placed;
        bytes += uses_[place].planned_gpu_bytes;
        if (placed.relief) {
            const bool counted = place > 0 && levels_[place - 1].placed.relief == placed.relief;
            bytes += counted ? 0 : relief::bytes_of(*placed.relief); // both ways of drawing share the relief
            continue;
        }
        bytes += scene::bytes_of(*placed.triangles);
        max_indices = std::max<std::uint64_t>(max_indices, placed.triangles->indices.size());
    }
    // The plan of an eye's picture lists the triangles that face the eye, and those that a face shows.
    return bytes + plans_.size() * 2 * sizeof(std::uint32_t) * max_indices;
}

std::size_t RunLevels::slot_of(const scene::QualityLevel& quality_level) const {
    return static_cast<std::size_t>(
        std::find_if(levels_.begin(), levels_.end(),
                     [&](const Level& l) { return l.shows.shows_as(quality_level); }) -
        levels_.begin());
}

scene::FrameWork RunLevels::work(const scene::QualityLevel& quality_level) const {
    scene::FrameWork work;
    for (const scene::FramePlan& plan : plans_) {
        const bool raster = quality_level.relief && !quality_level.on_gpu;
        const int samples = !raster                      ? plan.samples
                            : plan.relief_draw_count > 0 ? plan.relief_draws[0].samples
                                                         : quality_level.samples;
        // A slanting view takes more samples.
        work.pixels += static_cast<double>(plan.lit.pixels()) * samples / quality_level.samples;
        work.triangles +=
            quality_level.relief
                ? static_cast<double>(levels_[slot_of(quality_level)].placed.relief->blocks.size())
                : static_cast<double>(plan.indices.size()) / 3.0;
    }
    return work;
}

void RunLevels::plan(const geometry::PropShape& prop, std::span<const scene::Part> parts,
                     std::span<const scene::PlanView> views) {
    assert(views.size() == plans_.size());
    for (std::size_t eye = 0; eye < plans_.size(); ++eye) {
        scene::plan_frame(prop, parts, views[eye], plans_[eye]);
    }
}

double RunLevels::median_ms(const scene::QualityLevel& quality_level, const geometry::PropShape& prop,
                            std::span<const scene::PlanView> views, render::Renderer& renderer,
                            const render::RenderTarget& target) {
    const Level& level = levels_[slot_of(quality_level)];
    scene::PlacedLevel placed = level.placed;
    placed.samples = quality_level.samples;
    std::array<double, 7> ms{};
    std::size_t drawn = 0;
    double spent_ms = 0.0;
    while (drawn < 2 || (drawn < ms.size() && spent_ms < longest_measurement_ms)) {
        const auto start = std::chrono::steady_clock::now();
        plan(prop, whole(placed), views);
        renderer.draw(plans_, target, render::Redraw::Everything);
        render::wait_until_drawn();
        ms[drawn] =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        spent_ms += ms[drawn++];
    }
    // The first two frames (of only two, the first) are warm-up: shaders are compiled and buffers move to the
    // GPU's memory.
    return quantile_in(std::span(ms).first(drawn).subspan(std::min<std::size_t>(2, drawn - 1)), 0.5);
}

void RunLevels::measure(const geometry::PropShape& prop, std::span<const scene::PlanView> views,
                        render::Renderer& renderer, const render::RenderTarget& target) {
    std::vector<scene::QualityLevelTime> times(quality_levels_.size());
    for (std::size_t k = 0; k < quality_levels_.size(); ++k) {
        const double ms = median_ms(quality_levels_[k], prop, views, renderer, target);
        times[k] = {.samples = quality_levels_[k].samples,
                    .work = work(quality_levels_[k]),
                    .ms = ms,
                    .relief = quality_levels_[k].relief,
                    .on_gpu = quality_levels_[k].on_gpu};
    }
    // Repeat in reverse order: other load on the machine may have slowed some levels and not others. Levels
    // whose frames are slow are not measured again, to keep the start short.
    for (std::size_t k = quality_levels_.size(); k-- > 0;) {
        if (2.0 * times[k].ms < longest_measurement_ms) {
            times[k].ms = std::min(times[k].ms, median_ms(quality_levels_[k], prop, views, renderer, target));
        }
    }
    // The driver compiles its own programs at the first draw with a shader. Draw with each now, rather than
    // in the middle of a fade or at the first artifact with cut-out texels.
    for (const scene::ShaderKey& key : renderer.shaders()) {
        const bool is_raster = key.pass == scene::ShaderKey::Pass::Raster;
        const auto level = std::find_if(levels_.begin(), levels_.end(), [&](const Level& one) {
            return one.shows.relief == (is_raster || key.blocks) && one.shows.on_gpu == key.blocks;
        });
        if ((is_raster || key.pass == scene::ShaderKey::Pass::Surface) && !key.places &&
            (is_raster || key.even_light == views[0].light.has_value()) && level != levels_.end()) {
            scene::PlacedLevel placed = level->placed;
            placed.drawable.material.cut_out = key.cut_out;
            placed.light = glm::vec3(key.coloured ? 0.5F : 1.0F);
            if (key.dithered) {
                plan(prop, scene::fade(placed, placed, 0.5), views);
            } else {
                plan(prop, whole(placed), views);
            }
            renderer.draw(plans_, target, render::Redraw::Everything);
        }
    }
    // The shader of reliefs among polygons needs both in one picture.
    const auto level_where = [&](bool rasterized) {
        return std::find_if(levels_.begin(), levels_.end(), [&](const Level& one) {
            return (one.shows.relief && !one.shows.on_gpu) == rasterized;
        });
    };
    if (renderer.shaders().contains({scene::ShaderKey::Pass::RasterInDepth}) &&
        level_where(true) != levels_.end() && level_where(false) != levels_.end()) {
        plan(prop,
             std::array{scene::Part{level_where(true)->placed, std::nullopt},
                        scene::Part{level_where(false)->placed, std::nullopt}},
             views);
        renderer.draw(plans_, target, render::Redraw::Everything);
    }
    render::wait_until_drawn();
    start(times);
}

void RunLevels::start(const scene::FrameCost& cost, const geometry::PropShape& prop,
                      const scene::PlanView& view) {
    std::vector<scene::QualityLevelTime> times;
    for (const scene::QualityLevel& quality_level : quality_levels_) {
        scene::PlacedLevel placed = levels_[slot_of(quality_level)].placed;
        placed.samples = quality_level.samples;
        plan(prop, whole(placed), std::vector(plans_.size(), view));
        times.push_back({.samples = quality_level.samples,
                         .work = work(quality_level),
                         .ms = 0.0,
                         .relief = quality_level.relief,
                         .on_gpu = quality_level.on_gpu});
        times.back().ms = cost.ms(times.back());
    }
    start(times);
}

void RunLevels::start(const std::vector<scene::QualityLevelTime>& times) {
    times_ = times;
    governor_ = scene::Governor(quality_levels_, times, deadline_ms_);
    shown_ = slot_of(governor_.quality_level());
}

void RunLevels::enter(MonotonicTime now, double load) {
    governor_.enter(now, load);
    shown_ = slot_of(governor_.quality_level());
    coming_.reset();
}

scene::PlacedLevel RunLevels::placed(std::size_t slot) const {
    scene::PlacedLevel placed = levels_[slot].placed;
    placed.samples = governor_.quality_level().samples;
    return placed;
}

std::optional<scene::ErrorEstimate> RunLevels::estimate(const geometry::PropShape& prop,
                                                        std::span<const scene::PlanView> views) const {
    std::optional<scene::ErrorEstimate> worst;
    const auto add = [&](std::size_t slot, std::size_t eye) {
        worst = scene::larger(worst, scene::estimate_error(levels_[slot].seen, prop, levels_[slot].placed,
                                                           views[eye], plans_[eye]));
    };
    for (std::size_t eye = 0; eye < plans_.size(); ++eye) {
        add(shown_, eye);
        if (coming_) {
            add(*coming_, eye);
        }
    }
    return worst;
}

render::DrawResult RunLevels::draw(MonotonicTime now, const geometry::PropShape& prop,
                                   std::span<const scene::PlanView> views, render::Renderer& renderer,
                                   const render::RenderTarget& target, render::Redraw redraw,
                                   std::span<const scene::Part> marks) {
    const double share = coming_ ? geometry::ramp(to_seconds(now - fade_start_), level_fade_s) : 0.0;
    if (share >= 1.0) {
        shown_ = *coming_;
        coming_.reset();
    }
    parts_.clear();
    if (coming_) {
        const std::array<scene::Part, 2> fading = scene::fade(placed(shown_), placed(*coming_), share);
        parts_.assign(fading.begin(), fading.end());
    } else {
        parts_.push_back({placed(shown_), std::nullopt});
    }
    parts_.insert(parts_.end(), marks.begin(),
                  marks.begin() + static_cast<std::ptrdiff_t>(std::min(marks.size(), max_marks)));
    plan(prop, parts_, views);
    const render::DrawResult result = renderer.draw(plans_, target, redraw);
    if (result.drawn) { // otherwise the earlier picture and its error stay
        error_ = estimate(prop, views);
    }
    return result;
}

void RunLevels::record_time(MonotonicTime now, double ms) {
    const bool shows = std::any_of(plans_.begin(), plans_.end(),
                                   [](const scene::FramePlan& plan) { return !plan.faces.empty(); });
    if (coming_ || !shows) {
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
    return {.technique = technique_,
            .level = literal_of(to.shows),
            .samples = governor_.quality_level().samples,
            .error = error_,
            .switches = governor_.switches(),
            .ignored_times = governor_.ignored()};
}

} // namespace frustumscreen::residency
