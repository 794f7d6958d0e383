// Windows on the table: the eye at a grazing angle, on the table and below it, straight above and very near and far; a window at
// the picture's edge; a world whose depths differ a millionfold.

#include "app/bench/stability/picture.h"
#include "app/bench/stability/themes.h"
#include "app/scene/pinned_view.h"
#include "app/scene/window_plan.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace frustumscreen::bench {

namespace {

constexpr double size_m = 0.12;
constexpr double usual_world_m = 0.16; ///< along its box's longest edge

/// A window lies at `middle_m` on the table, as the usual kiosk's projector lights it. The world's box stands on z = 0 of the
/// window's frame, and the window lies at `height_m` in it; at the height of the box's top the world is wholly behind.
exact::SetUp window_at(const glm::dvec2& middle_m, double height_m, double yaw_rad = 0.3) {
    exact::SetUp set_up = usual_set_up();
    set_up.prop = scene::window_surface(size_m, size_m);
    geometry::PropFace& face = set_up.prop.faces.front();
    for (glm::dvec3& corner : face.corners) {
        corner.z = height_m;
    }
    face.plane.offset = height_m;
    set_up.table_from_prop = {glm::angleAxis(yaw_rad, glm::dvec3(0.0, 0.0, 1.0)), {middle_m, -height_m}};
    return set_up;
}
exact::SetUp usual_window(const glm::dvec2& middle_m = {0.2, 0.0}) {
    return window_at(middle_m, seen_box_size.z * usual_world_m);
}

/// The window's plan, in a frame whose prop stands beside it.
scene::FramePlan plan_of_window(const exact::SetUp& set_up, const SeenArtifact& artifact) {
    const exact::SetUp kiosk = usual_set_up();
    const scene::Part part{artifact.placed, std::nullopt};
    const scene::PlacedWindow window{
        .surface = &set_up.prop, .table_from_window = set_up.table_from_prop, .parts = std::span(&part, 1)};
    const scene::PlanView view{.projector = set_up.projector,
                               .table_from_projector = set_up.table_from_projector,
                               .table_from_prop = {{1.0, 0.0, 0.0, 0.0}, {-0.3, 0.0, 0.0}},
                               .eyes_m = {&set_up.eye_m, 1},
                               .windows = std::span(&window, 1)};
    scene::FramePlan plan = scene::make_plan(kiosk.prop, scene::PlacedLevel{});
    scene::make_window_space(plan, 1, artifact.placed.triangles->indices.size(), 1);
    scene::plan_frame(kiosk.prop, scene::PlacedLevel{}, view, plan);
    return std::move(plan.windows.front());
}

PictureFigures figures(const exact::SetUp& set_up, double world_m = usual_world_m) {
    const SeenArtifact artifact = seen_artifact(set_up, 2000, world_m);
    return figures_of(set_up, artifact, plan_of_window(set_up, artifact));
}

/// An eye `degrees` off the vertical and `away_m` from the middle.
glm::dvec3 eye_at(const glm::dvec2& middle_m, double degrees, double away_m) {
    const double angle = degrees * std::numbers::pi / 180.0;
    return glm::dvec3(middle_m, 0.0) +
           away_m * glm::dvec3(0.6 * std::sin(angle), -0.8 * std::sin(angle), std::cos(angle));
}

StabilityResult slanting(const StabilityOptions&) {
    StabilityResult result;
    const glm::dvec2 middle(0.2, 0.0);
    for (const double degrees : {0.0, 45.0, 80.0, 87.0, 89.0, 89.8}) {
        PictureFigures sum;
        for (const double away_m : {0.35, 0.6, 2.0}) {
            exact::SetUp set_up = usual_window(middle);
            set_up.eye_m = eye_at(middle, degrees, away_m);
            sum.include(figures(set_up));
        }
        const double per_sine = 1.0 / std::cos(degrees * std::numbers::pi / 180.0);
        append(result, rows_of(sum, fmt::format("{:g} deg: ", degrees), per_sine * bound_px,
                               per_sine * gpu_bound_px));
    }
    return result;
}

StabilityResult on_the_table_and_below(const StabilityOptions&) {
    double lit = 0.0;
    double not_finite = 0.0;
    for (const double height_m : {1e-300, 1e-12, 0.0, -1e-300, -1e-12, -1e-3, -0.3, -1e6}) {
        for (const glm::dvec2& foot : {glm::dvec2(0.2, 0.0), glm::dvec2(0.2, -0.4), glm::dvec2(0.26, 0.06)}) {
            exact::SetUp set_up = usual_window();
            set_up.eye_m = {foot, height_m};
            const SeenArtifact artifact = seen_artifact(set_up, 200, usual_world_m);
            const scene::FramePlan plan = plan_of_window(set_up, artifact);
            lit += static_cast<double>(plan.draws.size() + plan.faces.size());
            not_finite += figures_of(set_up, artifact, plan).not_finite;
        }
    }
    return {
        {{"draws in the window", 0.0, lit}, {"numbers in its plan that are not finite", 0.0, not_finite}}};
}

StabilityResult straight_above(const StabilityOptions&) {
    StabilityResult result;
    const glm::dvec2 middle(0.2, 0.0);
    for (const double away_m : {0.01, 0.1, 0.5, 1.2, 10.0, 100.0}) {
        exact::SetUp set_up = usual_window(middle);
        set_up.eye_m = eye_at(middle, 0.0, away_m);
        const double sine = std::fmin(1.0, away_m / 0.1); // nearer than the world is deep
        append(result, rows_of(figures(set_up), fmt::format("{:g} m: ", away_m), bound_px / sine,
                               gpu_bound_px / sine));
    }
    return result;
}

/// A window moves from the picture's middle over its edge until it is outside. Nothing is planned beyond the edge, and the part
/// inside is right.
StabilityResult at_the_edge(const StabilityOptions&) {
    StabilityResult result;
    const exact::SetUp kiosk = usual_set_up();
    const double half_m =
        0.5 * kiosk.projector.width / kiosk.projector.fx * kiosk.table_from_projector.translation.z;
    PictureFigures sum;
    double outside = 0.0;
    for (const double share : {0.8, 0.95, 1.0, 1.05, 1.5}) {
        exact::SetUp set_up = usual_window({share * half_m, 0.0});
        set_up.eye_m = {0.1, -0.5, 0.5};
        const SeenArtifact artifact = seen_artifact(set_up, 2000, usual_world_m);
        const scene::FramePlan plan = plan_of_window(set_up, artifact);
        sum.include(figures_of(set_up, artifact, plan));
        for (const scene::Draw& draw : plan.draws) {
            const PixelRectangle& bounds = draw.bounds;
            outside += bounds.x < 0 || bounds.y < 0 || bounds.x + bounds.width > kiosk.projector.width ||
                               bounds.y + bounds.height > kiosk.projector.height
                           ? 1.0
                           : 0.0;
        }
    }
    append(result, rows_of(sum, "", bound_px, gpu_bound_px));
    result.rows.push_back({"draws that reach out of the picture", 0.0, outside});
    return result;
}

/// Eye and window are in a world of 100 m, 0.1 mm below its top and 0.6 m lower. Surfaces nearer than 1/500 of the farthest
/// may be cut away.
StabilityResult deep_world(const StabilityOptions&) {
    constexpr double world_m = 100.0;
    constexpr double above_m = 0.6;
    const double top_m = seen_box_size.z * world_m;
    exact::SetUp set_up = window_at({0.2, 0.0}, top_m - above_m);
    set_up.eye_m = {0.2, 0.0, above_m - 1e-4};
    const SeenArtifact artifact = seen_artifact(set_up, 2000, world_m);
    const scene::FramePlan plan = plan_of_window(set_up, artifact);
    return {rows_of(figures_of(set_up, artifact, plan), "", 500.0 * bound_px, 500.0 * gpu_bound_px)};
}

/// The eye is nearer to the window than a thousandth of the way to the world's middle: the window is dark.
StabilityResult deeper_world(const StabilityOptions&) {
    double lit = 0.0;
    double not_finite = 0.0;
    for (const double world_m : {1e4, 1e6, 1e12}) {
        exact::SetUp set_up = window_at({0.2, 0.0}, seen_box_size.z * world_m);
        set_up.eye_m = {0.1, -0.4, 0.5};
        const SeenArtifact artifact = seen_artifact(set_up, 200, world_m);
        const scene::FramePlan plan = plan_of_window(set_up, artifact);
        lit += static_cast<double>(plan.draws.size());
        not_finite += figures_of(set_up, artifact, plan).not_finite;
    }
    return {
        {{"draws in the window", 0.0, lit}, {"numbers in its plan that are not finite", 0.0, not_finite}}};
}

/// For an eye anywhere above the table, the pinned world's ball lies behind the table, and its scale is finite.
StabilityResult pinned(const StabilityOptions&) {
    double before = 0.0;
    double not_finite = 0.0;
    double pins = 0.0;
    for (const double height_m : {1e-9, 1e-3, 0.1, 0.5, 3.0, 1e3}) {
        for (const glm::dvec2& foot : {glm::dvec2(0.3, 0.0), glm::dvec2(0.0, 0.0), glm::dvec2(0.0, -0.8),
                                       glm::dvec2(0.3, 1e-12), glm::dvec2(-50.0, 20.0)}) {
            const scene::PinRequest request{.table_from_prop = {},
                                            .prop_middle = {0.0, 0.0, 0.06},
                                            .eye_m = {foot, height_m},
                                            .world = {{0.01, 0.0, 0.05}, 0.06},
                                            .place = {.middle_m = {0.3, 0.0}}};
            const std::optional<scene::PinnedView> view = scene::pin_view(request);
            if (!view) {
                continue;
            }
            const glm::dvec3 middle(view->window_from_prop * glm::dvec4(request.world.middle, 1.0));
            not_finite += std::isfinite(middle.x + middle.y + middle.z + view->scale) ? 0.0 : 1.0;
            before += middle.z + view->scale * request.world.radius < 0.0 ? 0.0 : 1.0;
            pins += 1.0;
        }
    }
    return {{{"worlds that reach before their window", 0.0, before},
             {"places that are not finite", 0.0, not_finite},
             {"windows pinned, short of 30", 0.0, 30.0 - pins}}};
}

} // namespace

std::vector<StabilityCase> window_cases() {
    const std::string theme = "window";
    return {{theme, "a window seen at 0 to 89.8 degrees", FloatingPoint::Strict, slanting},
            {theme, "an eye on the table and below it", FloatingPoint::Strict, on_the_table_and_below},
            {theme, "eyes straight above, at 1 cm to 100 m", FloatingPoint::Strict, straight_above},
            {theme, "windows at the picture's edge", FloatingPoint::Strict, at_the_edge},
            {theme, "depths of 0.1 mm to 100 m", FloatingPoint::Strict, deep_world},
            {theme, "worlds of 10 km and more", FloatingPoint::Strict, deeper_world},
            {theme, "pinned from any place", FloatingPoint::Strict, pinned}};
}

} // namespace frustumscreen::bench
