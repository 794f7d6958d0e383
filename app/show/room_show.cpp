#include "app/show/room_show.h"

#include "app/geometry/time_curves.h"
#include "app/residency/run_levels.h"
#include "app/room/room_file.h"
#include "app/scene/governor.h"
#include "app/show/room_costs.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::show {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double us_per_part = 4.0;
/// Priorities of loading: the first quality level of each object precedes a better one of another object.
constexpr double first_urgency = 1e6, solid_urgency = 1e3, unseen_urgency = 0.1;

} // namespace

bool RoomShow::allows(const residency::KnownModel& model,
                      const residency::KnownQualityLevel& quality_level) const {
    const bool wanted = rasterizes_.value_or(true);
    return quality_level.relief == wanted ||
           std::none_of(model.quality_levels.begin(), model.quality_levels.end(),
                        [&](const residency::KnownQualityLevel& each) { return each.relief == wanted; });
}

double RoomShow::pixels_of(std::uint32_t object) const {
    const PlacedObject& placed = view_.objects()[object];
    const double px_per_m = 1.0 / (px_rad_ * (placed.away_m + placed.radius_m));
    const double all = static_cast<double>(screen_.pinhole.width) * screen_.pinhole.height;
    return std::min(placed.silhouette_m2 * px_per_m * px_per_m, all);
}

double RoomShow::error_px(const residency::KnownQualityLevel& quality_level, std::uint32_t object) const {
    const PlacedObject& placed = view_.objects()[object];
    return quality_level.judged_box * placed.size_m / (placed.away_m * px_rad_);
}

double RoomShow::cost_us(const residency::KnownQualityLevel& quality_level, std::uint32_t object) const {
    const scene::QualityLevelCost& cost = quality_level.relief ? cost_.raster : cost_.mesh;
    const auto eyes = static_cast<double>(plans_.size());
    const scene::FrameWork work{.triangles = eyes * quality_level.work, .pixels = eyes * pixels_of(object)};
    return 1e3 * (cost.ms(work, options_.samples) - cost.fixed_ms) + us_per_part;
}

std::uint32_t RoomShow::quickest_enough(std::uint32_t object) const {
    const residency::KnownModel& model = *models_->find(room_.objects[object].pack);
    std::uint32_t finest = none;
    std::uint32_t enough = none;
    for (std::uint32_t quality_level = 0; quality_level < model.quality_levels.size(); ++quality_level) {
        const residency::KnownQualityLevel& known = model.quality_levels[quality_level];
        if (!allows(model, known)) {
            continue;
        }
        finest = finest == none || known.judged_box < model.quality_levels[finest].judged_box ? quality_level
                                                                                              : finest;
        if (error_px(known, object) <= tolerance_px_ &&
            (enough == none || known.work < model.quality_levels[enough].work)) {
            enough = quality_level;
        }
    }
    return enough != none ? enough : finest;
}

void RoomShow::look(double seconds, std::span<const glm::dvec3> eyes_m) {
    const double pixel_m = glm::distance(screen_.surface.corners[0], screen_.surface.corners[1]) /
                           static_cast<double>(screen_.pinhole.width);
    const double before_m = screen_.surface.faces.front().plane.distance(eyes_m.front());
    px_rad_ = pixel_m / std::max(before_m, pixel_m);
    view_.look(
        seconds, eyes_m, taken_,
        [this](std::uint32_t object) -> const std::optional<scene::BoxCorners>* {
            const std::size_t pack = room_.objects[object].pack;
            // An object that is missing, or is fading in, hides nothing.
            return models_->find(pack) != nullptr && shown_[object].quality_level != none &&
                           models_->find(pack, shown_[object].quality_level) != nullptr
                       ? &models_->solid(pack)
                       : nullptr;
        },
        options_.culls);
    counts_ = {};
    for (const PlacedObject& object : view_.objects()) {
        counts_.in_view += object.is_in_view ? 1 : 0;
    }
    counts_.seen = view_.seen().size();
}

/// Compares the times of the quality levels that are good enough, loaded or not.
void RoomShow::choose_kind() {
    if (rasterizes_ || view_.seen().empty()) {
        return;
    }
    const auto sum_ms = [&](bool rasterizes) {
        rasterizes_ = rasterizes;
        double sum = rasterizes ? cost_.raster.fixed_ms : cost_.mesh.fixed_ms;
        for (const std::uint32_t object : view_.seen()) {
            const residency::KnownModel* const model = models_->find(room_.objects[object].pack);
            const std::uint32_t quality_level = model != nullptr ? quickest_enough(object) : none;
            sum += quality_level != none ? 1e-3 * cost_us(model->quality_levels[quality_level], object) : 0.0;
        }
        return sum;
    };
    const double raster_ms = sum_ms(true);
    rasterizes_ = raster_ms <= sum_ms(false);
}

void RoomShow::load() {
    models_->begin_frame();
    for (std::uint32_t object = 0; object < room_.objects.size(); ++object) {
        const std::size_t pack = room_.objects[object].pack;
        const residency::KnownModel* const model = models_->find(pack);
        if (model == nullptr) {
            continue;
        }
        const PlacedObject& placed = view_.objects()[object];
        const double nearness = (placed.is_seen ? 1.0 : unseen_urgency) / placed.away_m;
        std::uint32_t first = none;
        for (std::uint32_t quality_level = 0; quality_level < model->quality_levels.size(); ++quality_level) {
            if (allows(*model, model->quality_levels[quality_level]) &&
                (first == none ||
                 model->quality_levels[quality_level].work < model->quality_levels[first].work)) {
                first = quality_level;
            }
        }
        if (first == none) {
            continue;
        }
        models_->want(pack, first, placed.is_seen ? first_urgency * nearness : nearness);
        models_->want_solid(pack, placed.is_in_view ? solid_urgency * nearness : nearness);
        if (placed.is_seen) {
            models_->want(pack, quickest_enough(object), nearness);
            const Shown& shown = shown_[object];
            for (const std::uint32_t quality_level : {shown.quality_level, shown.coming}) {
                if (quality_level != none && shown.was_seen) {
                    models_->keep(pack, quality_level);
                }
            }
        }
    }
    models_->go_on();
    for (; faults_known_ < models_->faults().size(); ++faults_known_) {
        faults_.push_back(models_->faults()[faults_known_]);
    }
}

void RoomShow::choose(double seconds) {
    seen_.clear();
    options_of_seen_.clear();
    for (const std::uint32_t object : view_.seen()) {
        const std::size_t pack = room_.objects[object].pack;
        const residency::KnownModel* const model = models_->find(pack);
        if (model == nullptr) {
            continue;
        }
        seen_.push_back({.object = object,
                         .first = static_cast<std::uint32_t>(options_of_seen_.size()),
                         .count = static_cast<std::uint32_t>(model->quality_levels.size()),
                         .pixels = pixels_of(object)});
        for (std::size_t quality_level = 0; quality_level < model->quality_levels.size(); ++quality_level) {
            const bool can = allows(*model, model->quality_levels[quality_level]) &&
                             models_->find(pack, quality_level) != nullptr;
            options_of_seen_.push_back({error_px(model->quality_levels[quality_level], object),
                                        can ? cost_us(model->quality_levels[quality_level], object) : never});
        }
    }
    const double fixed_ms = rasterizes_.value_or(true) ? cost_.raster.fixed_ms : cost_.mesh.fixed_ms;
    const double budget_us =
        std::max(scene::Governor::leave_share * budget_us_ / std::exp(log_load_) - 1e3 * fixed_ms, 0.0);
    choice_.choose(seconds, seen_, options_of_seen_, tolerance_px_, budget_us);
    expected_ms_ = fixed_ms + 1e-3 * choice_.cost_us();
    counts_.is_short = choice_.is_short();
}

/// Follows the choice: starts, continues or ends the object's fade.
void RoomShow::change(std::uint32_t object, double seconds) {
    Shown& shown = shown_[object];
    const std::size_t pack = room_.objects[object].pack;
    const std::uint32_t chosen = choice_.of(object);
    const auto is_there = [&](std::uint32_t quality_level) {
        return quality_level != none && models_->find(pack, quality_level) != nullptr;
    };
    const double share =
        shown.coming != none ? geometry::ramp(seconds - shown.fade_start_s, residency::level_fade_s) : 0.0;
    if (!is_there(shown.coming) || share >= 1.0) {
        shown.quality_level = is_there(shown.coming) ? shown.coming : shown.quality_level;
        shown.coming = none;
    }
    shown.quality_level = is_there(shown.quality_level) ? shown.quality_level : none;
    if (!shown.was_seen) {
        shown = {.quality_level = chosen, .coming = none, .fade_start_s = 0.0, .was_seen = true};
        return;
    }
    if (chosen == none || chosen == shown.quality_level || shown.coming != none) {
        return;
    }
    if (counts_.fading < max_fades) {
        shown.coming = chosen;
        shown.fade_start_s = seconds;
    } else if (shown.quality_level != none && choice_.is_short()) {
        shown.quality_level = chosen;
    }
}

void RoomShow::add_part(std::uint32_t object, std::uint32_t quality_level,
                        const std::optional<scene::Dither>& dither) {
    scene::Part& part = parts_.emplace_back();
    part.level = *models_->find(room_.objects[object].pack, quality_level);
    part.level.metres_per_box = view_.objects()[object].size_m;
    part.level.samples = options_.samples;
    part.level.prop_from_placed = view_.objects()[object].table_from_object;
    part.dither = dither;
    indices_ += part.level.triangles ? part.level.triangles->indices.size() : 0;
    if (indices_ > max_indices_) { // the plans have no space for it
        indices_ -= part.level.triangles->indices.size();
        parts_.pop_back();
    }
}

void RoomShow::add_parts(double seconds) {
    parts_.clear();
    indices_ = 0;
    for (const scene::RoomSeen& each : seen_) {
        counts_.fading += shown_[each.object].coming != none ? 1 : 0;
    }
    double sum = 0.0;
    double weights = 0.0;
    for (const scene::RoomSeen& each : seen_) {
        Shown& shown = shown_[each.object];
        const bool faded = shown.coming != none;
        change(each.object, seconds);
        counts_.fading += shown.coming != none ? 1 : 0;
        counts_.fading -= faded ? 1 : 0;
        const double opacity = view_.objects()[each.object].opacity;
        if (opacity <
            1.0) { // a taken object uses the dither for its opacity, so it does not fade between two levels
            const std::uint32_t quality_level = shown.coming != none ? shown.coming : shown.quality_level;
            if (quality_level != none) {
                add_part(each.object, quality_level, scene::Dither{static_cast<float>(opacity), false});
            }
        } else if (shown.coming != none) {
            const auto share =
                static_cast<float>(geometry::ramp(seconds - shown.fade_start_s, residency::level_fade_s));
            if (shown.quality_level != none) {
                add_part(each.object, shown.quality_level, scene::Dither{share, true});
            }
            add_part(each.object, shown.coming, scene::Dither{share, false});
        } else if (shown.quality_level != none) {
            add_part(each.object, shown.quality_level, std::nullopt);
        }
        const std::uint32_t quality_level = shown.coming != none ? shown.coming : shown.quality_level;
        if (quality_level != none) {
            const std::size_t pack = room_.objects[each.object].pack;
            sum += each.pixels * 1e3 * models_->find(pack)->quality_levels[quality_level].mean_box *
                   view_.objects()[each.object].size_m;
            weights += each.pixels;
            ++counts_.drawn;
        }
    }
    error_mm_ = weights > 0.0 ? sum / weights : 0.0;
    for (std::uint32_t object = 0; object < shown_.size(); ++object) {
        shown_[object].was_seen = shown_[object].was_seen && view_.objects()[object].is_seen;
    }
}

render::DrawResult RoomShow::draw(double seconds, std::span<const glm::dvec3> eyes_m,
                                  const render::RenderTarget& target, render::Redraw redraw) {
    look(seconds, eyes_m.first(std::min(eyes_m.size(), layout_.count)));
    choose_kind();
    load();
    choose(seconds);
    add_parts(seconds);
    const scene::PlanView view{.projector = screen_.pinhole,
                               .table_from_projector = screen_.table_from_pinhole,
                               .table_from_prop = {},
                               .eyes_m = {},
                               .brightness = light_};
    const std::array<scene::PlanView, 2> views = scene::views_of(layout_, view, eyes_m);
    for (std::size_t eye = 0; eye < plans_.size(); ++eye) {
        scene::plan_frame(screen_.surface, parts_, views[eye], plans_[eye]);
    }
    return renderer_.draw(plans_, target, redraw);
}

void RoomShow::record_time(double ms) {
    if (scene::FrameTimeModel::is_time(ms) && expected_ms_ > 0.0) {
        constexpr double share = 0.08; // of each picture: as FrameTimeModel at 60 Hz
        log_load_ += share * (std::log(ms / expected_ms_) - log_load_);
    }
}

} // namespace frustumscreen::show
