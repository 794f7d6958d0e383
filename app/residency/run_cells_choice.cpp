// The choice of a level for each cell in a frame, by errors and times.
#include "app/geometry/time_curves.h"
#include "app/residency/run_cells.h"
#include "app/scene/beyond_prop.h"
#include "app/scene/cell_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::residency {

namespace {

/// The time of an option that is not offered.
constexpr double never = std::numeric_limits<double>::infinity();

} // namespace

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
    return {.error_mm = zoom() * option.worst_mm * (all_pixels > 0.0 ? pixels / all_pixels : 1.0),
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

void RunCells::judge_options() {
    for (Option& option : options_) {
        option.is_enough = is_good(option, zoom());
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
        const std::size_t end = end_of(k);
        for (std::size_t option = cells_[k].first; option < end; ++option) {
            offered_[option] = rasterized_[option] =
                option_of(options_[option], cells_[k].pixels, all_pixels, samples);
            if (is_site_ && !is_sharp(options_[option], zoom())) {
                offered_[option].cost_us = never;
            }
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
        drawn.cost_us = 0.0;
        for (std::size_t k = 0; k < cells_.size(); ++k) {
            const Option& target = options_[cells_[k].first + targets_[k]];
            drawn.cost_us += option_of(target, cells_[k].pixels, all_pixels, samples).cost_us;
        }
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
