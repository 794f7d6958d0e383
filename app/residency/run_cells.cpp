#include "app/residency/run_cells.h"

#include "app/geometry/time_curves.h"
#include "app/residency/site_mark.h"
#include "app/scene/beyond_prop.h"
#include "app/scene/cell_plan.h"
#include "app/scene/torch_plan.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace frustumscreen::residency {

namespace {

/// The time of an option that is not offered.
constexpr double never = std::numeric_limits<double>::infinity();

std::vector<world::Behaviour> behaviours_of(const pack::PackWorld& world) {
    std::vector<world::Behaviour> behaviours;
    for (const pack::PackBehaviour& behaviour : world.behaviours) {
        behaviours.push_back(behaviour.behaviour);
    }
    return behaviours;
}

std::uint64_t curve_bytes(const std::vector<world::Behaviour>& behaviours) {
    std::uint64_t bytes = 0;
    for (const world::Behaviour& behaviour : behaviours) {
        for (const world::Channel& channel : behaviour.channels) {
            bytes += channel.curve.times_s.size() * sizeof(float);
            bytes += channel.curve.values.size() * sizeof(glm::vec4);
        }
    }
    return bytes;
}

/// True if the plan counts this way of drawing as good enough.
bool is_enough(const scene::ScenePlan& plan, const PreparedLevel& level) {
    const scene::QualityLevel shown{.level = level.use.level,
                                    .samples = 1,
                                    .enough = false,
                                    .relief = level.data.relief != nullptr,
                                    .on_gpu = level.data.on_gpu};
    return std::any_of(plan.quality_levels.begin(), plan.quality_levels.end(),
                       [&](const scene::QualityLevel& each) { return each.enough && each.shows_as(shown); });
}

/// The largest zoom at which a level of a site's region is within the tolerance; 0 for a relief, which cannot be cut off.
double enough_to(const KnownWorld& known, const KnownCell& cell, const PreparedLevel& level) {
    if (level.data.relief) {
        return 0.0;
    }
    const pack::LevelError& error = cell.outline.levels[level.use.level].error;
    const double error_mm =
        1e3 * cell.plan.metres_per_box * scene::judged_error(error, scene::worst_of(level.seen));
    return error_mm > 0.0 ? known.tolerance_mm / error_mm : std::numeric_limits<double>::infinity();
}

std::size_t indices_of(const PreparedLevel& level) {
    const bool is_page = !level.triangles && !level.data.relief;
    return level.triangles ? level.triangles->indices.size() : is_page ? 3 * level.use.triangles : 0;
}

} // namespace

RunCells::RunCells(const pack::PackWorld& world, const KnownWorld& known, const scene::ScenePlan& whole,
                   std::span<const PreparedLevel> whole_levels, const PreparedCells& cells,
                   double deadline_ms)
    : metres_per_box_(whole.metres_per_box), deadline_ms_(deadline_ms),
      drawn_at_rest_(known.world.drawn_at_rest), is_site_(known.is_site),
      player_(pack::tree_of(world), behaviours_of(world)), choice_(cells.options),
      rasterized_choice_(cells.options), offered_(cells.levels.size()), rasterized_(cells.levels.size()) {
    std::size_t indices = 0; // of all that one picture may show
    for (const PreparedLevel& level : whole_levels) {
        indices = std::max(indices, indices_of(level));
    }
    for (std::size_t k = 0; k < known.drawn.size(); ++k) {
        const scene::ScenePlan& plan = known.drawn[k].plan;
        Cell& cell = cells_.emplace_back();
        cell.number = known.drawn[k].cell;
        cell.first = options_.size();
        std::array<std::size_t, 2> largest{};
        for (std::size_t option = 0; option < cells.options[k]; ++option) {
            const PreparedLevel& level = cells.levels[options_.size()];
            const bool there = level.triangles || level.data.relief;
            uses_.push_back(there ? level.use : LevelUse{.level = level.use.level});
            if (there) {
                given_.push_back(options_.size());
            }
            options_.push_back(
                {.seen = level.seen,
                 .placed = {.triangles = level.triangles,
                            .box_size = level.box_size,
                            .metres_per_box = plan.metres_per_box,
                            .drawable = {},
                            .samples = level.samples,
                            .faces = plan.faces,
                            .relief = level.data.relief,
                            .on_gpu = level.data.on_gpu},
                 .worst_mm =
                     1e3 * plan.metres_per_box * static_cast<double>(scene::worst_of(level.seen).mean_box),
                 .triangles = static_cast<double>(level.data.relief ? level.data.relief->blocks.size()
                                                                    : indices_of(level) / 6),
                 .is_enough = is_enough(plan, level),
                 .enough_to = is_site_ ? enough_to(known, known.drawn[k], level) : 0.0,
                 .there = there});
            largest.front() = std::max(largest.front(), indices_of(level));
            std::sort(largest.begin(), largest.end());
        }
        indices += largest[0] + largest[1];
        cell.wanted = cell.shown =
            cells.options[k] - 1; // the coarsest of a region; others choose before they draw
        const pack::PackCell& own = known.world.cells[cell.number];
        regions_.push_back({own.low, own.high});
    }
    wanted_.reserve(max_wanted_pages);
    by_pixels_.reserve(cells_.size());
    by_distance_.reserve(cells_.size());
    targets_.resize(cells_.size());
    can_rasterize_all_ = true;
    for (std::size_t k = 0; k < cells_.size(); ++k) {
        std::size_t rasterized = 0;
        bool enough = false;
        for (std::size_t option = cells_[k].first; option < cells_[k].first + cells.options[k]; ++option) {
            rasterized += is_rasterized(option) ? 1 : 0;
            enough = enough || (is_rasterized(option) && options_[option].is_enough);
        }
        can_rasterize_all_ = can_rasterize_all_ && (chooses_enough() ? enough : rasterized > 0);
        cells_[k].is_relief_alone = rasterized == cells.options[k];
    }
    if (is_site_) {
        SiteMark mark = make_site_mark();
        mark_data_ = std::move(mark.data);
        mark_.triangles = std::move(mark.triangles);
        mark_.samples = whole_levels.empty() ? 0 : whole_levels.front().samples;
        marks_.reserve(1);
        uses_.push_back(
            {.triangles = mark_.triangles->indices.size() / 3, .planned_gpu_bytes = mark.planned_gpu_bytes});
    }
    parts_.reserve(2 * cells_.size() + 1);
    for (std::size_t eye = 0; eye < whole.eyes; ++eye) {
        const std::size_t parts = 2 * cells_.size() + 1;
        plans_.push_back(scene::make_plan(whole.prop, indices, parts));
        if (!whole.needs.torches.empty()) {
            scene::make_torch_space(plans_.back(), whole.prop.faces.size(), indices, parts);
        }
    }
}

void RunCells::give(std::size_t place, const scene::Drawable& drawable, const render::GpuStore& store) {
    if (place == given_.size()) {
        mark_.drawable = drawable;
        uses_.back().gpu_bytes = store.bytes(drawable);
        return;
    }
    const std::size_t option = given_[place];
    options_[option].placed.drawable = drawable;
    uses_[option].gpu_bytes = store.bytes(drawable);
}

Result<void> RunCells::add_layer(render::GpuStore& store, const ReadLayer& layer) {
    for (std::size_t k = 0; k < cells_.size() && k < layer.cells.size(); ++k) {
        const std::size_t end = k + 1 < cells_.size() ? cells_[k + 1].first : options_.size();
        for (std::size_t option = cells_[k].first; option < end; ++option) {
            scene::PlacedLevel& placed = options_[option].placed;
            if (is_page(option)) { // a torch does not light the part of a site
                continue;
            }
            TRY_VOID(residency::add_layer(store, layer.cells[k], uses_[option].level,
                                          placed.relief != nullptr, placed.drawable));
        }
    }
    return {};
}

void RunCells::release(render::GpuStore& store) {
    for (const std::size_t option : given_) {
        store.release(options_[option].placed.drawable);
    }
    if (is_site_) {
        store.release(mark_.drawable);
    }
}

std::uint64_t RunCells::bytes() const {
    std::uint64_t bytes = curve_bytes(player_.behaviours());
    for (const std::size_t place : given_) {
        const scene::PlacedLevel& placed = options_[place].placed;
        bytes += uses_[place].planned_gpu_bytes;
        if (!placed.relief) {
            bytes += scene::bytes_of(*placed.triangles);
            // In the plan of an eye's picture, as RunLevels.
            bytes += plans_.size() * 2 * sizeof(std::uint32_t) * placed.triangles->indices.size();
        } else if (place == 0 || options_[place - 1].placed.relief != placed.relief) {
            bytes += relief::bytes_of(*placed.relief); // both ways of drawing share the relief
        }
    }
    return bytes;
}

void RunCells::start(const scene::FrameCost& cost) {
    const auto or_mesh = [&](const scene::QualityLevelCost& own) { // not measured: none of its kind was drawn
        return own.fixed_ms + own.ms_per_triangle + own.ms_per_sample > 0.0 ? own : cost.mesh;
    };
    cost_ = {cost.mesh, or_mesh(cost.raster), or_mesh(cost.on_gpu)};
    fixed_ms_ = std::max({cost_.mesh.fixed_ms, cost_.raster.fixed_ms, cost_.on_gpu.fixed_ms});
}

double RunCells::load() const {
    return std::exp(log_load_);
}

bool RunCells::fades() const {
    return leaves_ || arrives_ || std::any_of(cells_.begin(), cells_.end(), [](const Cell& cell) {
               return cell.coming.has_value();
           });
}

void RunCells::mark(const std::optional<world::RegionBox>& region) {
    marks_.clear();
    if (region && is_site_) {
        marks_.push_back({placed_mark(mark_, *region, metres_per_box_), std::nullopt});
    }
}

bool RunCells::step(MonotonicTime now, double load) {
    poses_ = player_.step(now);
    want_pages();
    if (!shows_) {
        parts_.clear(); // else the latest ones would keep their pages
    }
    if (player_.moves() || drawn_at_rest_ || site_) {
        if (!shows_) {
            is_new_ = true;
            arrives_ = site_ ? std::optional(now) : std::nullopt;
            log_load_ = load > 0.0 && std::isfinite(load) ? std::log(load) : 0.0;
            timed_ = now;
        }
        if (leaves_ && site_) { // back from where the fade is
            const Nanoseconds fade = Nanoseconds(std::llround(1e9 * level_fade_s));
            arrives_ = now - std::max(fade - (now - *leaves_), Nanoseconds(0));
        }
        shows_ = true;
        leaves_.reset();
    } else if (shows_ && !fades()) {
        leaves_ = now;
    } else if (leaves_ && to_seconds(now - *leaves_) >= level_fade_s) {
        shows_ = false;
        leaves_.reset();
    }
    return shows_;
}

scene::CellOption RunCells::option_of(const Option& option, double pixels, double all_pixels,
                                      int samples) const {
    const auto eyes = static_cast<double>(plans_.size());
    const scene::QualityLevelTime time{
        .samples = samples,
        .work = {.triangles = eyes * option.triangles, .pixels = eyes * pixels},
        .ms = 0.0,
        .relief = option.placed.relief != nullptr,
        .on_gpu = option.placed.on_gpu};
    const double ms = cost_.ms(time) - cost_.of(time).fixed_ms;
    if (is_beyond() && pixels == 0.0) {
        // No face shows it. When one does, it begins with its coarsest level.
        constexpr double next_to_nothing_us = 1e-6;
        return {.error_mm = 0.0, .cost_us = next_to_nothing_us * option.triangles};
    }
    const double zoom = site_ ? site_->zoom : 1.0;
    return {.error_mm = zoom * option.worst_mm * (all_pixels > 0.0 ? pixels / all_pixels : 1.0),
            .cost_us = 1e3 * ms};
}

void RunCells::offer_enough(std::size_t begin, std::size_t end,
                            std::vector<scene::CellOption>& offered) const {
    constexpr double as_quick = 1.1; // so that times that are almost equal do not change places at every pose
    std::size_t best = end;
    for (std::size_t option = begin; option < end; ++option) {
        const bool is_first = best == end || offered[option].cost_us < offered[best].cost_us;
        best = options_[option].is_enough && is_first ? option : best;
    }
    for (std::size_t option = begin; best < end && option < end; ++option) {
        const scene::CellOption& offer = offered[option];
        const double best_us = offered[best].cost_us;
        const bool saves_time = offer.cost_us < best_us && offer.error_mm > offered[best].error_mm;
        const bool is_as_quick = options_[option].is_enough && offer.cost_us <= as_quick * best_us;
        if (!saves_time && !is_as_quick) {
            offered[option].cost_us = never;
        }
    }
}

world::CellPose RunCells::pose_of(const Cell& cell) const {
    world::CellPose pose = poses_[cell.number];
    if (site_) {
        pose.box_from_geometry = site_->matrix() * pose.box_from_geometry;
    }
    return pose;
}

void RunCells::judge_options() {
    const double zoom = site_ ? site_->zoom : 1.0;
    for (Option& option : options_) {
        option.is_enough = zoom <= option.enough_to;
    }
}

void RunCells::choose(MonotonicTime now, int samples, const geometry::PropShape& prop,
                      const scene::PlanView& view) {
    double all_pixels = 0.0;
    for (Cell& cell : cells_) {
        scene::PlacedLevel placed = options_[cell.first + cell.shown].placed;
        scene::set_pose(placed, pose_of(cell), metres_per_box_);
        cell.pixels = is_beyond() ? scene::pixels_beyond(placed, prop, view) : scene::pixels_of(placed, view);
        all_pixels += cell.pixels;
    }
    if (leaves_ || (arrives_ && !is_new_)) {
        return;
    }
    if (is_site_) {
        judge_options();
    }
    for (std::size_t k = 0; k < cells_.size(); ++k) {
        const std::size_t end = k + 1 < cells_.size() ? cells_[k + 1].first : options_.size();
        for (std::size_t option = cells_[k].first; option < end; ++option) {
            offered_[option] = rasterized_[option] =
                option_of(options_[option], cells_[k].pixels, all_pixels, samples);
            if (!is_rasterized(option)) {
                rasterized_[option].cost_us = never;
            } else if (!cells_[k].is_relief_alone) {
                offered_[option].cost_us = never;
            }
        }
        if (chooses_enough()) {
            offer_enough(cells_[k].first, end, offered_);
            offer_enough(cells_[k].first, end, rasterized_);
        }
    }
    const double budget_us = 1e3 * (scene::Governor::leave_share * deadline_ms_ / load() - fixed_ms_);
    std::span<const std::size_t> chosen = choice_.choose(now, offered_, budget_us);
    scene::CellOption drawn = sum(chosen, offered_);
    if (can_rasterize_all_) {
        const std::span<const std::size_t> others = rasterized_choice_.choose(now, rasterized_, budget_us);
        const scene::CellOption rasterized = sum(others, rasterized_);
        choose_kind(now, drawn, rasterized, budget_us);
        chosen = rasterizes_all_ ? others : chosen;
        drawn = rasterizes_all_ ? rasterized : drawn;
    }
    for (std::size_t k = 0; k < cells_.size(); ++k) {
        cells_[k].wanted = chosen[k];
        targets_[k] = nearest_there(cells_[k]);
    }
    if (is_site_) {
        drawn = sum(targets_, offered_);
    }
    expected_ms_ =
        drawn.cost_us < never ? fixed_ms_ + 1e-3 * drawn.cost_us : 0.0; // 0: nothing is learned from its time
    for (std::size_t k = 0; k < cells_.size(); ++k) {
        Cell& cell = cells_[k];
        if (is_new_) {
            cell.shown = targets_[k];
            cell.coming.reset();
        } else if (!cell.coming && cell.shown != targets_[k]) {
            cell.coming = targets_[k];
            cell.fade_start = now;
            ++switches_;
        }
    }
    is_new_ = false;
}

scene::CellOption RunCells::sum(std::span<const std::size_t> chosen,
                                const std::vector<scene::CellOption>& offered) const {
    scene::CellOption sum;
    for (std::size_t k = 0; k < cells_.size(); ++k) {
        const scene::CellOption& option = offered[cells_[k].first + chosen[k]];
        sum.error_mm += option.error_mm;
        sum.cost_us += option.cost_us;
    }
    return sum;
}

/// As CellChoice: a kind is left for a clearly better one, and at once if it breaks the budget.
void RunCells::choose_kind(MonotonicTime now, const scene::CellOption& mixed,
                           const scene::CellOption& rasterized, double budget_us) {
    const auto is_better = [this, budget_us](const scene::CellOption& a, const scene::CellOption& b,
                                             double clearly) {
        if (chooses_enough() || b.cost_us > budget_us) {
            return (b.cost_us > budget_us && a.cost_us <= budget_us) || a.cost_us < clearly * b.cost_us;
        }
        return a.cost_us <= clearly * budget_us && a.error_mm < clearly * b.error_mm;
    };
    constexpr double clearly = 0.9;
    if (is_new_) {
        rasterizes_all_ = is_better(rasterized, mixed, 1.0);
        kind_changed_ = now;
        return;
    }
    const scene::CellOption& present = rasterizes_all_ ? rasterized : mixed;
    const scene::CellOption& other = rasterizes_all_ ? mixed : rasterized;
    const bool may_change = present.cost_us > budget_us || now - kind_changed_ >= scene::cell_dwell;
    if (may_change && is_better(other, present, clearly)) {
        rasterizes_all_ = !rasterizes_all_;
        kind_changed_ = now;
    }
}

void RunCells::add_part(const Cell& cell, std::size_t option, int samples,
                        const std::optional<scene::Dither>& dither) {
    scene::Part& part = parts_.emplace_back(scene::Part{options_[cell.first + option].placed, dither});
    part.level.samples = samples;
    scene::set_pose(part.level, pose_of(cell), metres_per_box_);
    part.level.beyond = is_beyond();
}

/// While the picture fades between the whole and the cells, no cell fades.
void RunCells::add_parts(MonotonicTime now, const scene::PlacedLevel& whole) {
    parts_.clear();
    std::optional<scene::Dither> of_all;
    if (leaves_) {
        const auto share = static_cast<float>(geometry::ramp(to_seconds(now - *leaves_), level_fade_s));
        parts_.push_back({whole, scene::Dither{share, false}});
        of_all = scene::Dither{share, true};
    } else if (arrives_ && to_seconds(now - *arrives_) < level_fade_s && !is_beyond()) {
        const auto share = static_cast<float>(geometry::ramp(to_seconds(now - *arrives_), level_fade_s));
        parts_.push_back({whole, scene::Dither{share, true}});
        of_all = scene::Dither{share, false};
    } else {
        arrives_.reset();
    }
    for (Cell& cell : cells_) {
        const double share =
            cell.coming ? geometry::ramp(to_seconds(now - cell.fade_start), level_fade_s) : 0.0;
        if (share >= 1.0) {
            cell.shown = *cell.coming;
            cell.coming.reset();
        }
        if (is_beyond() && cell.pixels == 0.0) {
            continue;
        }
        if (cell.coming) {
            const auto arrived = static_cast<float>(share);
            add_part(cell, cell.shown, whole.samples, scene::Dither{arrived, true});
            add_part(cell, *cell.coming, whole.samples, scene::Dither{arrived, false});
        } else {
            add_part(cell, cell.shown, whole.samples, of_all);
        }
    }
}

render::DrawResult RunCells::draw(MonotonicTime now, const scene::PlacedLevel& whole,
                                  const geometry::PropShape& prop, std::span<const scene::PlanView> views,
                                  render::Renderer& renderer, const render::RenderTarget& target,
                                  render::Redraw redraw) {
    assert(views.size() == plans_.size());
    choose(now, whole.samples, prop, views.front());
    add_parts(now, whole);
    for (std::size_t eye = 0; eye < plans_.size(); ++eye) {
        scene::plan_frame(prop, parts_, views[eye], plans_[eye]);
    }
    const render::DrawResult result = renderer.draw(plans_, target, redraw);
    if (result.drawn) {
        error_ = estimate(prop, views);
    }
    return result;
}

std::optional<scene::ErrorEstimate> RunCells::estimate(const geometry::PropShape& prop,
                                                       std::span<const scene::PlanView> views) const {
    std::optional<scene::ErrorEstimate> worst;
    for (std::size_t eye = 0; eye < plans_.size(); ++eye) {
        scene::ErrorEstimate sum;
        double pixels = 0.0;
        for (const Cell& cell : cells_) {
            const Option& option = options_[cell.first + cell.coming.value_or(cell.shown)];
            scene::PlacedLevel placed = option.placed;
            scene::set_pose(placed, pose_of(cell), metres_per_box_);
            placed.beyond = is_beyond();
            const auto own = scene::estimate_error(option.seen, prop, placed, views[eye], plans_[eye]);
            if (own) {
                sum.mean_mm += cell.pixels * own->mean_mm;
                sum.p95_mm += cell.pixels * own->p95_mm;
                pixels += cell.pixels;
            }
        }
        if (pixels > 0.0) {
            worst = scene::larger(worst, scene::ErrorEstimate{sum.mean_mm / pixels, sum.p95_mm / pixels});
        }
    }
    return worst;
}

/// As FrameTimeModel: the load follows the logarithm of measured over expected.
void RunCells::record_time(MonotonicTime now, double ms) {
    if (fades() || !scene::FrameTimeModel::is_time(ms) || !(expected_ms_ > 0.0)) {
        return;
    }
    const double dt_s = std::clamp(to_seconds(now - timed_), 0.0, scene::FrameTimeModel::max_dt_s);
    timed_ = now;
    const double share = geometry::follow_share(dt_s, scene::FrameTimeModel::time_constant_s);
    log_load_ += share * (std::log(ms / expected_ms_) - log_load_);
}

} // namespace frustumscreen::residency
