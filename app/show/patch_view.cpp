#include "app/show/patch_view.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::show {

namespace {

/// An eye between two cameras may see a place beside what either sees through the window alone.
constexpr double margin = 1.4;
constexpr int max_side = 1024; ///< points across a window

} // namespace

PatchView patch_view(const PatchViewRequest& request) {
    const geometry::RigidTransform& from_window = request.view.table_from_window;
    const glm::dvec2 half_m(request.view.surface.faces.front().corners[2]);
    const double pixel_m = glm::distance(request.table_from_projector.translation, from_window.translation) /
                           request.projector.fx;
    PatchView view;
    view.samples = request.samples > 1 ? 4 : 1;
    const double sample_m = pixel_m / (view.samples > 1 ? 2.0 : 1.0);
    const auto across = [&](double half) {
        return std::clamp(static_cast<int>(std::lround(points_along * 2.0 * half / sample_m)), 1, max_side);
    };
    view.cameras = {.half_extent_m = half_m,
                    .width = across(half_m.x),
                    .height = across(half_m.y),
                    .margin = margin,
                    .max_side = 2 * max_side};
    view.radius_m = glm::distance(request.eye_m, from_window.translation);
    // The world lies about half of the window's width behind it.
    const double behind_m = half_m.x;
    view.samples_per_m = view.radius_m / (view.radius_m + behind_m) / sample_m;
    return view;
}

} // namespace frustumscreen::show
