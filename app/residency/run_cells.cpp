#include "app/residency/run_cells.h"

#include "app/geometry/time_curves.h"
#include "app/residency/site_mark.h"
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
                 .sharp_to = level.sharp_to,
                 .there = there});
            largest.front() = std::max(largest.front(), indices_of(level));
            std::sort(largest.begin(), largest.end());
        }
        if (is_site_) {
            options_[options_.size() - 2].sharp_from =
                options_.back().sharp_to; // the same level as the proxy
        }
        indices += largest[0] + largest[1];
        cell.wanted = cell.shown = cells.options[k] - 1; // a region's proxy; others choose before they draw
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
    note_gpu_bytes(store, drawable, uses_[option]);
}

Result<void> RunCells::add_layer(render::GpuStore& store, const ReadLayer& layer) {
    for (std::size_t k = 0; k < cells_.size() && k < layer.cells.size(); ++k) {
        const std::size_t end = end_of(k);
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
        if (leaves_ && site_) { // back before the fade has ended: it continues from where it is
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

world::CellPose RunCells::pose_of(const Cell& cell) const {
    world::CellPose pose = poses_[cell.number];
    if (site_) {
        pose.box_from_geometry = site_->matrix() * pose.box_from_geometry;
    }
    return pose;
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

} // namespace frustumscreen::residency
