#include "app/settings/focus_range.h"

#include "app/settings/lit_zone.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::settings {

namespace {

/// The opening in units of a pixel's angle: the blur in pixels is this times the difference of 1 / depth. The finer
/// pixels count.
double sharpness_m(const ProjectorSettings& projector) {
    return 1e-3 * projector.aperture_mm * std::max(projector.pinhole.fx, projector.pinhole.fy);
}

/// The least depth at which a ball fits between two opposite edges of the picture, given as slopes from the optical
/// axis: there it touches both planes.
double min_depth_m(double ball_m, double one, double other) {
    return ball_m * (std::hypot(1.0, one) + std::hypot(1.0, other)) / (one + other);
}

/// The least depth of the prop's middle at which all of the prop lies in the picture however it is turned.
double highest_middle_m(const geometry::Pinhole& pinhole, double ball_m) {
    const double left = pinhole.cx / pinhole.fx, right = (pinhole.width - pinhole.cx) / pinhole.fx;
    const double top = pinhole.cy / pinhole.fy, bottom = (pinhole.height - pinhole.cy) / pinhole.fy;
    return std::fmax(min_depth_m(ball_m, left, right), min_depth_m(ball_m, top, bottom));
}

} // namespace

double blur_px(const ProjectorSettings& projector, double focus_m, double depth_m) {
    return sharpness_m(projector) * std::abs(1.0 / focus_m - 1.0 / depth_m);
}

DepthRange sharp_depths(const ProjectorSettings& projector, double focus_m) {
    const double s = sharpness_m(projector);
    return {.nearest_m = s * focus_m / (s + focus_m),
            .farthest_m =
                s > focus_m ? s * focus_m / (s - focus_m) : std::numeric_limits<double>::infinity()};
}

double largest_aperture_mm(const ProjectorSettings& projector, const DepthRange& range) {
    // Blur grows with the difference of 1 / depth, so the near end decides.
    return projector.aperture_mm / blur_px(projector, range.middle_m(), range.nearest_m);
}

std::optional<DepthRange> lit_depths(const Settings& settings) {
    const geometry::RigidTransform projector_from_table = settings.projector.table_from_projector.inverse();
    const geometry::PropShape prop = make_prop(settings.prop);
    const bool in_hand = settings.prop.zone == PropZone::Hand;
    double ball_m = 0.0, top_m = 0.0;
    for (const glm::dvec3& corner : prop.corners) {
        ball_m = std::fmax(ball_m, glm::distance(corner, prop.middle));
        top_m = std::fmax(top_m, corner.z);
    }
    DepthRange range{.nearest_m = std::numeric_limits<double>::infinity(), .farthest_m = 0.0};
    for (const glm::dvec2& place : lit_zone(settings).any_eye) {
        const double on_table = projector_from_table.point({place, 0.0}).z;
        const double on_top = projector_from_table.point({place, in_hand ? 0.0 : top_m}).z;
        range.nearest_m = std::min({range.nearest_m, on_table, on_top});
        range.farthest_m = std::max({range.farthest_m, on_table, on_top});
    }
    if (!(range.farthest_m > 0.0)) {
        return std::nullopt;
    }
    if (in_hand) {
        range.nearest_m = highest_middle_m(settings.projector.pinhole, ball_m) - ball_m;
    }
    return range;
}

} // namespace frustumscreen::settings
