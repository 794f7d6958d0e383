#include "app/scene/window_plan.h"

#include "app/geometry/corner_fan.h"
#include "app/geometry/planar_hull.h"
#include "app/scene/face_view.h"
#include "app/scene/prop_outline.h"
#include "app/scene/torch_plan.h"
#include "app/scene/window_patches.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <span>

namespace frustumscreen::scene {

namespace {

/// Half a pixel keeps windows out of every pixel that the prop touches; another half is for the prop's feathered edge.
constexpr double cover_margin_px = 1.0;
constexpr std::size_t corners_of_pixel = 4;

/// The prop's outline in the projector's picture.
struct Cover {
    bool all = false;   ///< the prop reaches to the projector or behind it
    PixelRectangle lit; ///< around the outline
    std::array<glm::vec4, corners_of_pixel * geometry::max_corners> clip{};
    std::size_t count = 0; ///< of corners
};

Cover cover_of(const geometry::PropShape& prop, const PlanView& view) {
    constexpr std::size_t most = corners_of_pixel * geometry::max_corners;
    assert(prop.corners.size() <= geometry::max_corners);
    Cover cover;
    if (prop.corners.empty()) {
        return cover;
    }
    const geometry::RigidTransform projector_from_prop =
        view.table_from_projector.inverse() * view.table_from_prop;
    const geometry::Pinhole ideal = view.projector.ideal(); // the lens bends the draws later
    std::array<glm::dvec2, most> points{};
    std::size_t count = 0;
    for (const glm::dvec3& corner : prop.corners) {
        const std::optional<glm::dvec2> pixel = ideal.pixel(projector_from_prop.point(corner));
        if (!pixel || !std::isfinite(pixel->x + pixel->y)) {
            cover.all = true;
            return cover;
        }
        for (unsigned k = 0; k < corners_of_pixel; ++k) {
            points[count++] =
                *pixel + cover_margin_px * (2.0 * glm::dvec2(k & 1U, k >> 1U & 1U) - glm::dvec2(1.0));
        }
    }
    std::array<glm::dvec2, most + 1> chain{};
    const std::span<const glm::dvec2> hull = geometry::planar_hull(std::span(points).first(count), chain);
    cover.count = hull.size();
    std::array<glm::dvec4, most> clip{};
    for (std::size_t k = 0; k < cover.count; ++k) {
        clip[k] = {2.0 * hull[k] / glm::dvec2(ideal.width, ideal.height) - 1.0, 0.0, 1.0};
        cover.clip[k] = glm::vec4(clip[k]);
    }
    cover.lit = pixels_around(std::span(clip).first(cover.count), view.projector);
    return cover;
}

/// The view of a window: as the prop's, with the window in the prop's place.
PlanView through(const PlacedWindow& window, const PlanView& view) {
    PlanView seen{.projector = view.projector,
                  .table_from_projector = view.table_from_projector,
                  .table_from_prop = window.table_from_window,
                  .eyes_m = view.eyes_m,
                  .light = view.light,
                  .brightness = window.brightness,
                  .picture = view.picture,
                  .dimming_eyes_m = view.dimming_eyes_m,
                  .torches = window.torches};
    if (seen.light) {
        seen.light->hull.reset(); // the hull is that of the prop's world
    }
    return seen;
}

/// No points: the window's parts are drawn. A lens that bends straight lines would bend the points' places too, so their parts are
/// drawn there.
ShownPoints points_of(const PlacedWindow& window, const PlanView& view) {
    if (window.patches == nullptr || !window.torches.empty() || view.eyes_m.empty() ||
        if_it_bends(view.projector)) {
        return {};
    }
    return shown_to(*window.patches, window.table_from_window.inverse().point(view.eyes_m.front()));
}

void plan_points(const PlacedWindow& window, const ShownPoints& shown, const PlanView& view,
                 FramePlan& plan) {
    const Part part = part_of(*window.patches, {.points = shown.points});
    plan_frame(*window.surface, std::span(&part, 1), view, plan);
}

/// The points have the samples that they have alone, because those of the part may depend on its scale.
void plan_fade(const PlacedWindow& window, const ShownPoints& shown, const PlanView& view, FramePlan& plan) {
    plan_points(window, shown, view, plan);
    const int samples = plan.relief_draw_count > 0 ? plan.relief_draws.front().samples : 1;
    const std::array both{window.parts.front(), part_of(*window.patches, shown)};
    plan_frame(*window.surface, both, view, plan);
    for (ReliefDraw& drawn : plan.relief_draws) {
        drawn.samples = drawn.points != nullptr ? samples : drawn.samples;
    }
}

void plan_window(const PlacedWindow& window, const PlanView& view, const Cover& cover, FramePlan& plan) {
    const PlanView seen = through(window, view);
    const glm::dmat4 clip_from_window =
        view.projector.clip_from_point() *
        (view.table_from_projector.inverse() * window.table_from_window).matrix();
    plan.cover_clip.clear();
    if (!intersected(cover.lit, prop_bounds(*window.surface, view.projector, clip_from_window)).empty()) {
        plan.cover_clip.assign(cover.clip.begin(),
                               cover.clip.begin() + static_cast<std::ptrdiff_t>(cover.count));
    }
    const ShownPoints shown = points_of(window, seen);
    const bool fades = shown.share > 0.0F && shown.share < 1.0F && window.parts.size() == 1;
    if (shown.points != nullptr && fades) {
        plan_fade(window, shown, seen, plan);
    } else if (shown.points != nullptr && shown.share >= 0.5F) {
        plan_points(window, shown, seen, plan);
    } else {
        plan_frame(*window.surface, window.parts, seen, plan);
    }
}

} // namespace

void make_window_space(FramePlan& plan, std::size_t windows, std::size_t indices, std::size_t parts,
                       bool torches) {
    geometry::PropShape surface;
    geometry::PropFace& face = surface.faces.emplace_back();
    for (std::size_t k = 0; k < geometry::max_face_corners; ++k) {
        face.corners.push_back({});
    }
    plan.windows.clear();
    plan.windows.reserve(windows);
    for (std::size_t k = 0; k < windows; ++k) {
        FramePlan& window = plan.windows.emplace_back(make_plan(surface, indices, parts));
        window.cover_clip.reserve(corners_of_pixel * geometry::max_corners);
        if (torches) {
            make_torch_space(window, surface.faces.size(), indices, parts);
        }
    }
    plan.draws.reserve(plan.draws.capacity() + windows * geometry::fan_quads(face.corners.size()));
}

void plan_windows(const geometry::PropShape& prop, const PlanView& view, FramePlan& plan) {
    plan.window_count = 0;
    if (view.windows.empty() || plan.windows.empty()) {
        return;
    }
    const Cover cover = cover_of(prop, view);
    if (cover.all) {
        return;
    }
    plan.window_count = std::min(view.windows.size(), plan.windows.size());
    for (std::size_t k = 0; k < plan.window_count; ++k) {
        plan_window(view.windows[k], view, cover, plan.windows[k]);
    }
}

} // namespace frustumscreen::scene
