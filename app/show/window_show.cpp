#include "app/show/window_show.h"

#include "app/scene/scene_level.h"
#include "app/scene/window_plan.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace frustumscreen::show {

namespace {

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
    : windows_(settings.windows), torches_(settings.torch.exists()),
      frame_m_(line_width_m(settings.projector)), prop_middle_m_(prop.middle), prop_ball_(ball_of(prop)),
      samples_(1e3 / settings.projector.refresh_hz), frozen_(settings.projector, waits) {
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
    std::size_t indices = 0, regions = 0;
    std::size_t parts = 2; // one, and points that fade over it
    for (std::size_t artifact = 0; artifact < cache.size(); ++artifact) {
        const residency::KnownArtifact& known = cache.known(artifact);
        artifacts.push_back(&known);
        indices = std::max(indices, max_indices_of(known.outline, known.plan));
        if (known.world) {
            std::size_t of_cells = 0;
            const std::size_t levels = known.world->is_site ? 2 : 1; // a region fades from one to another
            for (const residency::KnownCell& cell : known.world->drawn) {
                of_cells += levels * max_indices_of(cell.outline, cell.plan);
            }
            indices = std::max(indices, of_cells);
            parts = std::max(parts, levels * known.world->drawn.size());
            regions = std::max(regions, known.world->is_site ? known.world->drawn.size() : 0);
        }
    }
    frozen_.make_space(artifacts);
    for (scene::FramePlan& space : spaces_) {
        scene::make_window_space(space, windows_.count, indices, parts, torches_);
    }
    const auto make = [&](Held& held) {
        held = {};
        held.parts.reserve(parts + 1); // with the whole artifact, while it fades to its cells or back
        held.moved.reserve(parts + 1);
        held.seen.reserve(regions);
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
