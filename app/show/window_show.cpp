#include "app/show/window_show.h"

#include "app/exhibit/site_places.h"
#include "app/geometry/time_curves.h"
#include "app/scene/scene_level.h"
#include "app/scene/window_plan.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace frustumscreen::show {

namespace {

/// The share of a window's light for an eye: 1 up to full_deg from the window's normal, 0 from limit_deg on.
double share_for(const glm::dvec3& eye_m, const glm::dvec2& middle_m) {
    const double across = glm::distance(glm::dvec2(eye_m), middle_m);
    const double slant_deg = glm::degrees(std::atan2(across, eye_m.z));
    return geometry::ease((WindowShow::limit_deg - slant_deg) /
                          (WindowShow::limit_deg - WindowShow::full_deg));
}

/// The indices of the largest level of an artifact or a cell.
std::size_t max_indices_of(const pack::PackOutline& outline, const scene::ScenePlan& plan) {
    std::uint64_t triangles = 0;
    for (const std::uint32_t level : plan.levels) {
        triangles = std::max(triangles, outline.levels[level].triangles);
    }
    return static_cast<std::size_t>(3 * triangles);
}

/// The width of the frame's lines. A line narrower than a pixel may lie between two rows of pixels.
double line_width_m(const settings::ProjectorSettings& projector) {
    const double pixel_m = glm::length(projector.table_from_projector.translation) / projector.pinhole.fx;
    return std::clamp(WindowShow::frame_px * pixel_m, WindowShow::min_frame_m, WindowShow::max_frame_m);
}

scene::WindowPlace place_of(const typography::TableRectangle& rectangle) {
    return {.middle_m = rectangle.centre_m,
            .yaw_rad = 0.5 * std::numbers::pi * rectangle.quarter_turns,
            .width_m = rectangle.size_m.x,
            .depth_m = rectangle.size_m.y};
}

bool is_beyond(std::span<const scene::Part> parts) {
    return std::any_of(parts.begin(), parts.end(), [](const scene::Part& part) { return part.level.beyond; });
}

scene::WorldBall ball_of(const geometry::PropShape& prop) {
    scene::WorldBall ball{.middle = prop.middle, .radius = 0.0};
    for (const glm::dvec3& corner : prop.corners) {
        ball.radius = std::max(ball.radius, glm::distance(corner, ball.middle));
    }
    return ball;
}

} // namespace

WindowShow::WindowShow(const settings::Settings& settings, const geometry::PropShape& prop, std::size_t eyes,
                       bool waits)
    : windows_(settings.windows), frame_m_(line_width_m(settings.projector)), prop_middle_m_(prop.middle),
      prop_ball_(ball_of(prop)), samples_(1e3 / settings.projector.refresh_hz),
      frozen_(settings.projector, waits) {
    for (std::size_t eye = 0; eye < eyes; ++eye) {
        spaces_.push_back(scene::make_plan(prop, 0, 1));
    }
}

Result<void> WindowShow::prepare(render::GpuStore& store) {
    TRY(white_, store.upload(image::Image<std::uint8_t>(1, 1, 255)));
    return {};
}

std::uint64_t WindowShow::planned_gpu_bytes() const {
    return scene::caption_gpu_bytes(1, 1);
}

void WindowShow::make_space(const residency::ArtifactCache& cache) {
    std::vector<const residency::KnownArtifact*> artifacts;
    std::size_t indices = 0, parts = 1;
    for (std::size_t artifact = 0; artifact < cache.size(); ++artifact) {
        const residency::KnownArtifact& known = cache.known(artifact);
        artifacts.push_back(&known);
        indices = std::max(indices, max_indices_of(known.outline, known.plan));
        if (known.world) {
            std::size_t of_cells = 0;
            for (const residency::KnownCell& cell : known.world->drawn) {
                of_cells += max_indices_of(cell.outline, cell.plan);
            }
            indices = std::max(indices, of_cells);
            parts = std::max(parts, known.world->drawn.size());
        }
    }
    frozen_.make_space(artifacts);
    for (scene::FramePlan& space : spaces_) {
        scene::make_window_space(space, windows_.count, indices, parts);
    }
    const auto make = [&](Held& held) {
        held = {};
        held.parts.reserve(parts + 1); // with the whole artifact, while it fades to its cells or back
        held.moved.reserve(parts + 1);
        held.view.surface = scene::window_surface(windows_.width_m, windows_.depth_m);
    };
    std::for_each(held_.begin(), held_.end(), make);
    make(preview_);
}

std::span<const std::size_t> WindowShow::layers_of(const residency::KnownArtifact& artifact) {
    std::size_t count = 0;
    for (const pack::PackState& state : artifact.states) {
        const auto end = layers_.begin() + static_cast<std::ptrdiff_t>(count);
        if (state.layer && std::find(layers_.begin(), end, *state.layer) == end) {
            layers_.at(count++) = *state.layer;
        }
    }
    return std::span(layers_).first(count);
}

void WindowShow::place_frames(const exhibit::Presentation& presentation, double brightness,
                              residency::OnTable& on_table) const {
    const auto place_frame = [&](const typography::TableRectangle& rectangle, double of_window) {
        const auto& [middle, size, turns] = rectangle;
        const glm::dvec2 off = 0.5 * (size + frame_m_);
        const auto add = [&](const glm::dvec2& at, const glm::dvec2& side) {
            on_table.add({.corners_m = residency::picture_corners(
                              {middle + typography::turned(at, turns), side, turns}),
                          .brightness = frame_brightness * brightness * of_window,
                          .texture = white_});
        };
        for (const double side : {-1.0, 1.0}) {
            add({side * off.x, 0.0}, {frame_m_, size.y + 2.0 * frame_m_});
            add({0.0, side * off.y}, {size.x, frame_m_});
        }
    };
    for (const exhibit::PresentedWindow& window : presentation.windows.windows()) {
        place_frame(window.rectangle, window.brightness);
    }
    if (preview_.number != 0 && presentation.site_map) {
        place_frame(presentation.site_map->rectangle, presentation.site_map->brightness);
    }
}

/// Keeps the parts that the prop shows, or those of a state. If two levels fade in a cell, it keeps the one that fades in.
void WindowShow::freeze(const exhibit::PresentedWindow& window, const residency::ArtifactCache& cache,
                        Held& held) const {
    held.parts.clear();
    held.is_frozen = true;
    const residency::RunCells* const cells = cache.find_cells(window.artifact);
    const residency::RunLevels& levels = *cache.find(window.artifact);
    if (window.state && cells != nullptr) {
        held.is_frozen = cells->show_state(*window.state, held.parts);
    } else if (window.state) {
        const std::optional<std::size_t> layer = cache.known(window.artifact).states.at(*window.state).layer;
        const std::optional<scene::PlacedLevel> shown = layer ? levels.in_layer(*layer) : levels.shown();
        held.is_frozen = shown.has_value();
        if (shown) {
            held.parts.push_back({*shown, std::nullopt});
        }
    } else if (window.live && cells != nullptr) {
        cells->show_moving(held.parts);
    } else if (cells != nullptr) {
        for (const scene::Part& part : cells->parts()) {
            if (!part.dither || !part.dither->complement) {
                held.parts.push_back({part.level, std::nullopt});
            }
        }
    }
    if (held.is_frozen && held.parts.empty()) {
        held.parts.push_back({levels.shown(), std::nullopt});
    }
}

void WindowShow::aim(const exhibit::PresentedWindow& window, const std::optional<scene::WorldBall>& states,
                     Held& held) const {
    held.comings = window.comings;
    held.turn_rad = window.turn_rad;
    held.zoom = window.zoom;
    held.is_aimed = false;
    std::optional<scene::WorldBall> ball = states;
    if (is_beyond(held.parts)) { // a part of a site: what the prop shows, not all that reaches out of it
        ball = prop_ball_;
    } else if (!ball || !scene::contains(*ball, held.parts)) {
        ball = scene::ball_around(held.parts);
        ball = ball && states ? std::optional(scene::united(*ball, *states)) : ball;
    }
    if (!ball) {
        return;
    }
    held.is_aimed = scene::pin_view({.table_from_prop = window.table_from_prop,
                                     .prop_middle = prop_middle_m_,
                                     .eye_m = window.eye_m,
                                     .world = *ball,
                                     .place = place_of(window.rectangle),
                                     .turn = glm::angleAxis(window.turn_rad, glm::dvec3(0.0, 0.0, 1.0)),
                                     .zoom = window.zoom},
                                    held.view);
    if (held.is_aimed) {
        scene::move_behind(held.view.window_from_prop, held.parts, held.moved);
    }
}

/// As the parts had when they were frozen, or one.
void WindowShow::set_samples(Held& held) const {
    for (std::size_t k = 0; k < held.moved.size(); ++k) {
        held.moved[k].level.samples = samples_.few() ? 1 : held.parts[k].level.samples;
    }
}

void WindowShow::go_on(const residency::RunCells& cells, Held& held) const {
    held.parts.clear();
    cells.show_moving(held.parts);
    scene::move_behind(held.view.window_from_prop, held.parts, held.moved);
}

WindowShow::Held& WindowShow::held_of(const exhibit::PresentedWindow& window,
                                      const exhibit::PresentedWindows& presented,
                                      const residency::ArtifactCache& cache) {
    const auto is_presented = [&](const Held& held) {
        const auto all = presented.windows();
        return std::any_of(all.begin(), all.end(),
                           [&](const auto& one) { return one.number == held.number; });
    };
    auto* found = std::find_if(held_.begin(), held_.end(),
                               [&](const Held& held) { return held.number == window.number; });
    if (found ==
        held_.end()) { // takes the entry of a window that has gone: there are as many entries as windows
        found = std::find_if_not(held_.begin(), held_.end(), is_presented);
        assert(found != held_.end());
        found->number = window.number;
        found->comings = 0;
        found->is_aimed = false;
        found->is_frozen = false;
        found->follows = false;
        found->lost = cache.find(window.artifact) == nullptr;
    }
    if (!found->lost && !found->is_frozen && cache.find(window.artifact) != nullptr) {
        freeze(window, cache, *found);
    }
    return *found;
}

void WindowShow::begin_patches(const exhibit::PresentedWindow& window, const residency::ArtifactCache& cache,
                               Held& held) {
    held.follows = window.follows;
    const residency::KnownArtifact& known = cache.known(window.artifact);
    const bool in_layer = window.state && known.states.at(*window.state).layer;
    // Patches are of a world that lies behind the window; a part of a site goes on before it.
    if (!held.is_aimed || window.follows || window.live || in_layer || is_beyond(held.parts)) {
        frozen_.forget(window.number);
    } else {
        frozen_.freeze({.number = window.number,
                        .artifact = window.artifact,
                        .known = known,
                        .shown = cache.find(window.artifact)->shown_quality(),
                        .parts = held.moved,
                        .view = held.view,
                        .eye_m = window.eye_m});
    }
}

const scene::WindowPatches* WindowShow::patches_for(std::uint32_t number,
                                                    const geometry::RigidTransform& table_from_window,
                                                    std::span<const glm::dvec3> eyes_m) {
    std::array<glm::dvec3, 2> eyes{};
    const std::size_t count = std::min(eyes.size(), eyes_m.size());
    const geometry::RigidTransform window_from_table = table_from_window.inverse();
    for (std::size_t k = 0; k < count; ++k) {
        eyes[k] = window_from_table.point(eyes_m[k]);
    }
    return frozen_.look(number, std::span(eyes).first(count));
}

std::span<const scene::PlacedWindow> WindowShow::place(const exhibit::Presentation& presentation,
                                                       std::span<const glm::dvec3> eyes_m,
                                                       const residency::ArtifactCache& cache) {
    std::size_t count = 0;
    for (const exhibit::PresentedWindow& window : presentation.windows.windows()) {
        Held& held = held_of(window, presentation.windows, cache);
        held.lost = held.lost || cache.find(window.artifact) == nullptr;
        if (held.lost || !held.is_frozen || window.comings == 0) {
            continue;
        }
        const residency::RunCells* const cells = cache.find_cells(window.artifact);
        const bool is_new =
            held.comings != window.comings || held.turn_rad != window.turn_rad || held.zoom != window.zoom;
        if (is_new) {
            aim(window, cells != nullptr ? cells->states_ball() : std::nullopt, held);
        }
        if (is_new || held.follows != window.follows) {
            begin_patches(window, cache, held);
        }
        if (window.live && held.is_aimed && cells != nullptr && window.artifact == presentation.artifact) {
            go_on(*cells, held);
        }
        double share = 1.0;
        for (const glm::dvec3& eye : eyes_m) {
            share = std::min(share, share_for(eye, window.rectangle.centre_m));
        }
        const double brightness = cache.exposure(window.artifact) * window.brightness * share;
        if (!held.is_aimed || brightness <= 0.0 || count >= placed_.size()) {
            continue;
        }
        set_samples(held);
        geometry::RigidTransform table_from_window = held.view.table_from_window;
        table_from_window.translation =
            glm::dvec3(window.rectangle.centre_m, table_from_window.translation.z);
        placed_.at(count++) = {.surface = &held.view.surface,
                               .table_from_window = table_from_window,
                               .parts = held.moved,
                               .brightness = brightness,
                               .patches = patches_for(window.number, table_from_window, eyes_m)};
    }
    if (count < windows_.count) { // the plans have room for so many
        count += place_preview(presentation, eyes_m, cache, placed_.at(count)) ? 1 : 0;
    }
    frozen_.step(presentation.windows.windows());
    shows_ = count > 0;
    return std::span(placed_).first(count);
}

bool WindowShow::place_preview(const exhibit::Presentation& presentation, std::span<const glm::dvec3> eyes_m,
                               const residency::ArtifactCache& cache, scene::PlacedWindow& placed) {
    const std::optional<exhibit::PresentedTitle>& place = presentation.site_map;
    const residency::RunCells* const cells = cache.find_cells(presentation.artifact);
    if (!place || place->title.behaviour < exhibit::site_preview_title || cells == nullptr) {
        preview_.number = 0;
        return false;
    }
    const auto number = static_cast<std::uint32_t>(place->title.behaviour);
    const bool is_marked =
        cells->goal() && cells->goal()->region + exhibit::site_preview_title == place->title.behaviour;
    if (is_marked) { // else it fades out as it is
        if (preview_.number != number) {
            preview_.number = number;
            preview_eye_m_ = eyes_m.front();
            preview_table_from_prop_ = presentation.table_from_prop;
        }
        preview_.parts.clear();
        cells->show_goal(preview_.parts);
        aim({.number = 0,
             .artifact = presentation.artifact,
             .comings = 0,
             .rectangle = place->rectangle,
             .eye_m = preview_eye_m_,
             .table_from_prop = preview_table_from_prop_,
             .brightness = 1.0},
            std::nullopt, preview_);
    }
    double share = 1.0;
    for (const glm::dvec3& eye : eyes_m) {
        share = std::min(share, share_for(eye, place->rectangle.centre_m));
    }
    const double brightness = cache.exposure(presentation.artifact) * place->brightness * share;
    if (preview_.number != number || !preview_.is_aimed || brightness <= 0.0) {
        return false;
    }
    set_samples(preview_);
    placed = {.surface = &preview_.view.surface,
              .table_from_window = preview_.view.table_from_window,
              .parts = preview_.moved,
              .brightness = brightness};
    return true;
}

std::span<const scene::PlacedWindow> WindowShow::sample(const scene::PlacedLevel& level,
                                                        const glm::dvec2& place_m, const glm::dvec3& eye_m) {
    Held& held = held_.front();
    held.parts.assign(1, {level, std::nullopt});
    aim({.number = 0,
         .artifact = 0,
         .comings = 0,
         .rectangle = {place_m, {windows_.width_m, windows_.depth_m}, 0},
         .eye_m = eye_m,
         .table_from_prop = {},
         .brightness = 1.0},
        std::nullopt, held);
    if (!held.is_aimed) {
        return {};
    }
    placed_.front() = {.surface = &held.view.surface,
                       .table_from_window = held.view.table_from_window,
                       .parts = held.moved,
                       .brightness = 1.0};
    return std::span(placed_).first(1);
}

void WindowShow::swap_space(std::span<scene::FramePlan> plans) {
    for (std::size_t eye = 0; eye < std::min(plans.size(), spaces_.size()); ++eye) {
        std::swap(plans[eye].windows, spaces_[eye].windows);
        plans[eye].window_count = 0;
    }
}

} // namespace frustumscreen::show
