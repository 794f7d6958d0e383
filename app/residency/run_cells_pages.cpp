// The pages of a site's regions: which are wanted, and what is drawn until they come.
#include "app/geometry/time_curves.h"
#include "app/residency/run_cells.h"
#include "app/scene/cell_plan.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::residency {

namespace {

bool touch(const world::RegionBox& a, const world::RegionBox& b) {
    constexpr double rounding = 1e-6;
    return glm::all(glm::lessThanEqual(glm::dvec2(a.low), glm::dvec2(b.high) + rounding)) &&
           glm::all(glm::lessThanEqual(glm::dvec2(b.low), glm::dvec2(a.high) + rounding));
}

} // namespace

std::size_t RunCells::nearest_there(const Cell& cell) const {
    const auto can_show = [&](std::size_t option) {
        const Option& of = options_[cell.first + option];
        return of.there && !of.leaves;
    };
    if (can_show(cell.wanted)) {
        return cell.wanted;
    }
    if (cell.shown < cell.wanted && can_show(cell.shown)) {
        return cell.shown; // it is finer than the wanted one
    }
    for (std::size_t option = cell.wanted; options_[cell.first + cell.wanted].is_enough && option-- > 0;) {
        if (can_show(option) && options_[cell.first + option].is_enough) {
            return option;
        }
    }
    std::size_t option = cell.wanted;
    while (!can_show(option)) { // the proxy is always there
        ++option;
    }
    return option;
}

void RunCells::want_page(std::size_t place) {
    const bool is_new = std::find(wanted_.begin(), wanted_.end(), place) == wanted_.end();
    if (is_page(place) && is_new && wanted_.size() < max_wanted_pages) {
        wanted_.push_back(place);
        options_[place].leaves = false;
    }
}

std::size_t RunCells::option_at(std::size_t cell, double zoom) const {
    std::size_t option = end_of(cell) - 1;
    while (option > cells_[cell].first && !is_good(options_[option], zoom)) {
        --option;
    }
    return option;
}

void RunCells::expect_in_windows(std::span<const world::SiteView> views) {
    in_windows_count_ = std::min(views.size(), in_windows_.size());
    std::copy_n(views.begin(), in_windows_count_, in_windows_.begin());
}

std::size_t RunCells::option_in_window(std::size_t cell, double zoom) const {
    std::size_t option = option_at(cell, zoom);
    while (!options_[option].there || options_[option].leaves) { // the proxy is always there
        ++option;
    }
    return option;
}

void RunCells::show_part(MonotonicTime now, const world::SiteView& view, std::vector<SeenRegion>& seen,
                         std::vector<scene::Part>& parts) const {
    if (poses_.empty()) {
        return;
    }
    if (seen.size() != cells_.size()) {
        seen.clear();
        for (std::size_t k = 0; k < cells_.size(); ++k) {
            seen.push_back({.shown = option_in_window(k, view.zoom), .coming = {}, .fade_start = {}});
        }
    }
    for (std::size_t k = 0; k < cells_.size(); ++k) {
        SeenRegion& region = seen[k];
        const std::size_t wanted = option_in_window(k, view.zoom);
        const double share =
            region.coming ? geometry::ramp(to_seconds(now - region.fade_start), level_fade_s) : 0.0;
        if (share >= 1.0) {
            region.shown = *std::exchange(region.coming, std::nullopt);
        }
        if (!region.coming && !options_[region.shown].there) {
            region.shown = wanted;
        } else if (!region.coming && region.shown != wanted) {
            region.coming = wanted;
            region.fade_start = now;
        }
        world::CellPose pose = poses_[cells_[k].number];
        pose.box_from_geometry = view.matrix() * pose.box_from_geometry;
        const auto add = [&](std::size_t option, const std::optional<scene::Dither>& dither) {
            scene::Part& part = parts.emplace_back(scene::Part{options_[option].placed, dither});
            scene::set_pose(part.level, pose, metres_per_box_);
            part.level.beyond = true;
        };
        if (region.coming) {
            const auto arrived = static_cast<float>(share < 1.0 ? share : 0.0);
            add(region.shown, scene::Dither{arrived, true});
            add(*region.coming, scene::Dither{arrived, false});
        } else {
            add(region.shown, std::nullopt);
        }
    }
}

void RunCells::want_pages_around(const world::SiteView& view) {
    constexpr double around = 1.5; // the prop's ground is 1 across
    const auto away = [&](std::size_t cell) {
        return glm::length(glm::dvec2(view.point(world::ground_of(regions_[cell]))));
    };
    by_distance_.clear();
    for (std::size_t k = 0; k < cells_.size(); ++k) {
        const glm::dvec2 low(view.point(regions_[k].low));
        const glm::dvec2 high(view.point(regions_[k].high));
        if (low.x < around && low.y < around && high.x > -around && high.y > -around) {
            by_distance_.push_back({away(k), k});
        }
    }
    std::sort(by_distance_.begin(), by_distance_.end());
    for (const auto& [distance, k] : by_distance_) {
        // A page that is to leave for what the prop shows is not wanted back at once.
        const std::size_t place = option_at(k, view.zoom);
        Option& option = options_[place];
        option.kept_out = std::max(option.kept_out - 1, 0);
        const bool leaves = option.leaves && option.kept_out > 0;
        want_page(place);
        option.leaves = option.leaves || leaves;
    }
}

void RunCells::want_pages() {
    wanted_.clear();
    if (!is_site_) {
        return;
    }
    if (shows_) {
        by_pixels_.clear();
        for (std::size_t k = 0; k < cells_.size(); ++k) {
            if (cells_[k].pixels > 0.0) {
                by_pixels_.push_back(k);
            }
        }
        std::sort(by_pixels_.begin(), by_pixels_.end(), [this](std::size_t a, std::size_t b) {
            return cells_[a].pixels > cells_[b].pixels || (cells_[a].pixels == cells_[b].pixels && a < b);
        });
        for (const std::size_t k : by_pixels_) {
            want_page(cells_[k].first + cells_[k].wanted);
        }
    }
    if (goal_ && goal_->region < cells_.size()) {
        want_page(option_at(goal_->region, goal_->view.zoom));
        for (std::size_t k = 0; k < cells_.size(); ++k) {
            if (k != goal_->region && touch(regions_[k], regions_[goal_->region])) {
                want_page(option_at(k, goal_->view.zoom));
            }
        }
    }
    for (std::size_t k = 0; k < in_windows_count_; ++k) {
        want_pages_around(in_windows_[k]);
    }
}

std::uint64_t RunCells::page_texture_bytes(std::size_t place) const {
    const auto after = std::upper_bound(cells_.begin(), cells_.end(), place,
                                        [](std::size_t p, const Cell& cell) { return p < cell.first; });
    const LevelUse& proxy = uses_[end_of(static_cast<std::size_t>(after - cells_.begin()) - 1) - 1];
    constexpr std::uint64_t per_texel = sizeof(glm::u8vec4);
    const auto texels =
        static_cast<std::uint64_t>(proxy.texture.x) * static_cast<std::uint64_t>(proxy.texture.y)
        << static_cast<unsigned>(2 * proxy.finest_mip);
    return per_texel * texels * 4 / 3; // with its mip levels
}

void RunCells::give_page(std::size_t place, const PreparedLevel& level, const scene::Drawable& drawable,
                         const render::GpuStore& store) {
    Option& option = options_.at(place);
    option.placed.triangles = level.triangles;
    option.placed.drawable = drawable;
    option.there = true;
    option.leaves = false;
    uses_[place] = level.use;
    uses_[place].gpu_bytes = store.bytes(drawable);
}

bool RunCells::let_go(std::size_t place) {
    constexpr int keep_out_steps = 120;
    Option& option = options_.at(place);
    option.leaves = true;
    option.kept_out = keep_out_steps;
    for (const Cell& cell : cells_) {
        if (cell.first + cell.shown == place || (cell.coming && cell.first + *cell.coming == place)) {
            return false;
        }
    }
    constexpr long own = 2; // this and the page itself; a window has a copy
    return option.placed.triangles.use_count() <= own;
}

void RunCells::take_page(std::size_t place) {
    Option& option = options_.at(place);
    option.there = false;
    option.placed.triangles.reset();
    option.placed.drawable = {};
    uses_[place] = {.level = uses_[place].level};
}

} // namespace frustumscreen::residency
