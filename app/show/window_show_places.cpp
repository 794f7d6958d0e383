// The part of WindowShow that freezes windows and places them.

#include "app/exhibit/site_places.h"
#include "app/geometry/time_curves.h"
#include "app/show/window_show.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace frustumscreen::show {

namespace {

/// The share of a window's light for an eye: 1 up to full_deg from the window's normal, 0 from limit_deg on.
double share_for(const glm::dvec3& eye_m, const glm::dvec2& middle_m) {
    const double across = glm::distance(glm::dvec2(eye_m), middle_m);
    const double slant_deg = glm::degrees(std::atan2(across, eye_m.z));
    return geometry::ease((WindowShow::limit_deg - slant_deg) /
                          (WindowShow::limit_deg - WindowShow::full_deg));
}

/// The least of all eyes.
double share_for(std::span<const glm::dvec3> eyes_m, const glm::dvec2& middle_m) {
    double share = 1.0;
    for (const glm::dvec3& eye_m : eyes_m) {
        share = std::min(share, share_for(eye_m, middle_m));
    }
    return share;
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

} // namespace

/// Keeps the parts that the prop shows, or those of a state. If two levels fade in a cell, it keeps the one that fades in.
void WindowShow::freeze(MonotonicTime now, const exhibit::PresentedWindow& window,
                        const residency::ArtifactCache& cache, Held& held) const {
    held.let_go();
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
    } else if (cells != nullptr && cells->shown_part()) {
        held.part = cells->shown_part();
        cells->show_part(now, *held.part, held.seen, held.parts);
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

/// Sets the samples that the parts had when they were frozen, or one a pixel while window frames are slow
/// (window_samples.h).
void WindowShow::set_samples(Held& held) const {
    for (std::size_t k = 0; k < held.moved.size(); ++k) {
        held.moved[k].level.samples = samples_.few() ? 1 : held.parts[k].level.samples;
    }
}

void WindowShow::refresh(MonotonicTime now, const residency::RunCells& cells, Held& held) {
    held.parts.clear();
    cells.show_part(now, *held.part, held.seen, held.parts);
    scene::move_behind(held.view.window_from_prop, held.parts, held.moved);
}

void WindowShow::expect_parts(const exhibit::Presentation& presentation,
                              const residency::ArtifactCache& cache) const {
    const auto windows = presentation.windows.windows();
    const auto expect = [&](std::size_t artifact) {
        std::array<world::SiteView, settings::max_windows> views{};
        std::size_t count = 0;
        for (const Held& held : held_) {
            const bool is_of_it = std::any_of(windows.begin(), windows.end(), [&](const auto& window) {
                return window.number == held.number && window.artifact == artifact;
            });
            if (is_of_it && held.part && !held.lost && count < views.size()) {
                views.at(count++) = *held.part;
            }
        }
        if (residency::RunCells* const cells = cache.find_cells(artifact)) {
            cells->expect_in_windows(std::span(views).first(count));
        }
    };
    expect(presentation.artifact); // its last window may have gone
    for (const exhibit::PresentedWindow& window : windows) {
        expect(window.artifact);
    }
}

void WindowShow::go_on(const exhibit::PresentedWindow& window, const residency::ArtifactCache& cache,
                       const LightInProp& light, Held& held) const {
    held.parts.clear();
    if (const residency::RunCells* const cells = cache.find_cells(window.artifact)) {
        cells->show_moving(held.parts);
    } else {
        held.parts.push_back({cache.find(window.artifact)->shown(), std::nullopt});
    }
    scene::move_behind(held.view.window_from_prop, held.parts, held.moved);
    held.light.keep(light);
}

void WindowShow::Held::let_go() {
    parts.clear();
    moved.clear();
    part.reset();
    seen.clear();
}

void WindowShow::let_go(const exhibit::PresentedWindows& presented) {
    for (Held& held : held_) {
        const auto all = presented.windows();
        if (std::none_of(all.begin(), all.end(),
                         [&](const auto& window) { return window.number == held.number; })) {
            held.let_go();
            held.light.put_out();
        }
    }
}

void WindowShow::limit_light(Held& held) const {
    const std::optional<scene::WorldBall> ball =
        is_beyond(held.parts) ? std::optional(prop_ball_) : scene::ball_around(held.parts);
    if (ball) {
        held.light.leave_out_beside(*ball);
    } else {
        held.light.put_out();
    }
}

WindowShow::Held& WindowShow::held_of(MonotonicTime now, const exhibit::PresentedWindow& window,
                                      const exhibit::PresentedWindows& presented,
                                      const residency::ArtifactCache& cache, const LightInProp& light) {
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
        found->artifact = window.artifact;
        found->comings = 0;
        found->is_aimed = false;
        found->is_frozen = false;
        found->follows = false;
        found->light.put_out();
        found->lost = cache.find(window.artifact) == nullptr;
        if (!found->lost) {
            found->light.keep(light); // the layer of a state may come later
        }
    }
    if (!found->lost && !found->is_frozen && cache.find(window.artifact) != nullptr) {
        freeze(now, window, cache, *found);
        if (found->is_frozen) {
            limit_light(*found);
        }
    }
    return *found;
}

void WindowShow::begin_patches(const exhibit::PresentedWindow& window, const residency::ArtifactCache& cache,
                               Held& held) {
    held.follows = window.follows;
    const residency::KnownArtifact& known = cache.known(window.artifact);
    const bool in_layer = window.state && known.states.at(*window.state).layer;
    // Patches show a world that lies behind the window, in its own colours. A part of a site extends in front of the
    // window.
    if (!held.is_aimed || window.follows || window.live || in_layer || held.light.is_lit() ||
        is_beyond(held.parts)) {
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
                                                    std::span<const glm::dvec3> eyes_m, MonotonicTime now) {
    std::array<glm::dvec3, 2> eyes{};
    const std::size_t count = std::min(eyes.size(), eyes_m.size());
    const geometry::RigidTransform window_from_table = table_from_window.inverse();
    for (std::size_t k = 0; k < count; ++k) {
        eyes[k] = window_from_table.point(eyes_m[k]);
    }
    return frozen_.look(number, std::span(eyes).first(count), now,
                        samples_.few() ? short_fade_s : scene::PointFade::fade_s);
}

void WindowShow::update(MonotonicTime now, const exhibit::PresentedWindow& window, bool is_on_show,
                        const residency::ArtifactCache& cache, const LightInProp& light, Held& held) {
    const residency::RunCells* const cells = cache.find_cells(window.artifact);
    const bool is_new =
        held.comings != window.comings || held.turn_rad != window.turn_rad || held.zoom != window.zoom;
    if (is_new) {
        aim(window, cells != nullptr ? cells->states_ball() : std::nullopt, held);
    }
    if (is_new || held.follows != window.follows) {
        begin_patches(window, cache, held);
    }
    if (held.part && held.is_aimed && cells != nullptr) {
        refresh(now, *cells, held);
        if (window.live && is_on_show && cells->shown_part() == held.part) {
            held.light.keep(light);
        }
    } else if (window.live && !window.state && held.is_aimed && is_on_show) {
        go_on(window, cache, light, held);
    }
}

bool WindowShow::fades() const {
    const auto fades = [](const Held& held) {
        return held.light.fades() || std::any_of(held.seen.begin(), held.seen.end(), [](const auto& region) {
                   return region.coming.has_value();
               });
    };
    return frozen_.fades() || fades(preview_) || std::any_of(held_.begin(), held_.end(), fades);
}

bool WindowShow::shows_contents_of(std::size_t artifact) const {
    return std::any_of(held_.begin(), held_.end(), [artifact](const Held& held) {
        return held.artifact == artifact && held.light.shows_textures();
    });
}

std::span<const scene::PlacedWindow> WindowShow::place(MonotonicTime now,
                                                       const exhibit::Presentation& presentation,
                                                       std::span<const glm::dvec3> eyes_m,
                                                       const residency::ArtifactCache& cache,
                                                       std::span<const scene::PlacedTorch> torches) {
    const LightInProp light{.torches = torches,
                            .table_from_prop = presentation.table_from_prop,
                            .house_light = presentation.torches.house_light};
    let_go(presentation.windows);
    std::size_t count = 0;
    for (const exhibit::PresentedWindow& window : presentation.windows.windows()) {
        Held& held = held_of(now, window, presentation.windows, cache, light);
        held.lost = held.lost || cache.find(window.artifact) == nullptr;
        if (held.lost) {
            held.let_go();
            held.light.put_out();
        }
        const bool is_on_show = window.artifact == presentation.artifact;
        const bool is_darker = held.light.fade_textures(now, is_on_show);
        if (held.lost || !held.is_frozen || window.comings == 0) {
            continue;
        }
        update(now, window, is_on_show, cache, light, held);
        if (is_darker) {
            begin_patches(window, cache, held); // its own colours are left
        }
        const double brightness = cache.exposure(window.artifact) * window.brightness *
                                  share_for(eyes_m, window.rectangle.centre_m) * held.light.house_light();
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
                               .patches = patches_for(window.number, table_from_window, eyes_m, now),
                               .torches = held.light.behind(held.view, table_from_window)};
    }
    if (count < windows_.count) { // the plans have space for so many windows
        count += place_preview(now, presentation, eyes_m, cache, placed_.at(count)) ? 1 : 0;
    }
    expect_parts(presentation, cache);
    frozen_.step(presentation.windows.windows());
    shows_ = count > 0;
    return std::span(placed_).first(count);
}

bool WindowShow::place_preview(MonotonicTime now, const exhibit::Presentation& presentation,
                               std::span<const glm::dvec3> eyes_m, const residency::ArtifactCache& cache,
                               scene::PlacedWindow& placed) {
    const std::optional<exhibit::PresentedTitle>& place = presentation.site_map;
    const residency::RunCells* const cells = cache.find_cells(presentation.artifact);
    if (!place || place->title.behaviour < exhibit::site_preview_title || cells == nullptr) {
        preview_.number = 0;
        preview_.let_go();
        return false;
    }
    const auto number = static_cast<std::uint32_t>(place->title.behaviour);
    const bool is_marked =
        cells->goal() && cells->goal()->region + exhibit::site_preview_title == place->title.behaviour;
    if (is_marked) { // else it fades out as it is
        if (preview_.number != number) {
            preview_.number = number;
            preview_.seen.clear();
            preview_eye_m_ = eyes_m.front();
            preview_table_from_prop_ = presentation.table_from_prop;
        }
        preview_.parts.clear();
        cells->show_part(now, cells->goal()->view, preview_.seen, preview_.parts);
        aim({.number = 0,
             .artifact = presentation.artifact,
             .comings = 0,
             .rectangle = place->rectangle,
             .eye_m = preview_eye_m_,
             .table_from_prop = preview_table_from_prop_,
             .brightness = 1.0},
            std::nullopt, preview_);
    }
    const double brightness = cache.exposure(presentation.artifact) * place->brightness *
                              share_for(eyes_m, place->rectangle.centre_m);
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

} // namespace frustumscreen::show
