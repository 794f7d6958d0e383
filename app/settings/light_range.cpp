#include "app/settings/light_range.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace frustumscreen::settings {

namespace {

constexpr double min_share_of_brightest = 0.25;
constexpr int yaws_of_quarter = 30;

/// Adds the prop in one pose, given by the lens in the prop's frame.
void include(const geometry::PropShape& prop, const glm::dvec3& lens, LightRange& range) {
    double darkest = std::numeric_limits<double>::infinity();
    double brightest = 0.0;
    for (const geometry::PropFace& face : prop.faces) {
        const double at_middle = received_light(face.plane, face.middle(), lens);
        darkest = std::min(darkest, at_middle);
        brightest = std::max(brightest, at_middle);
        for (const glm::dvec3& corner : face.corners) {
            const double light = received_light(face.plane, corner, lens);
            range.least = std::min(range.least, light);
            range.most = std::max(range.most, light);
        }
    }
    range.most = std::max(range.most, brightest);
    range.evenness = std::min(range.evenness, brightest > 0.0 ? darkest / brightest : 0.0);
}

} // namespace

double received_light(const geometry::Plane& face, const glm::dvec3& point, const glm::dvec3& projector) {
    const double d = glm::distance(projector, point);
    return face.distance(projector) / (d * d * d);
}

glm::dvec2 reach_on_table(const PropSettings& prop, const TableSettings& table) {
    const double half_diagonal_m = prop.base_m / std::numbers::sqrt2;
    return glm::max(0.5 * glm::dvec2(table.width_m, table.depth_m) - half_diagonal_m, glm::dvec2(0.0));
}

LightRange light_range(const geometry::PropShape& prop, const glm::dvec3& lens, const glm::dvec2& reach_m) {
    const int yaws = yaws_of_quarter * geometry::quarters_to_same(prop);
    LightRange range{std::numeric_limits<double>::infinity(), 0.0, 1.0};
    for (int place = 0; place < 9; ++place) {
        const glm::dvec2 at = reach_m * glm::dvec2(place % 3 - 1, place / 3 - 1);
        const glm::dvec3 to_lens = lens - glm::dvec3(at, 0.0);
        for (int k = 0; k < yaws; ++k) {
            const double yaw = 0.5 * std::numbers::pi * k / yaws_of_quarter;
            const double c = std::cos(yaw);
            const double s = std::sin(yaw);
            include(prop, {c * to_lens.x + s * to_lens.y, c * to_lens.y - s * to_lens.x, to_lens.z}, range);
        }
    }
    return range;
}

double even_light(const Settings& settings) {
    const geometry::PropShape prop = make_prop(settings.prop);
    const glm::dvec3 lens = settings.projector.table_from_projector.translation;
    if (settings.prop.zone == PropZone::Hand) {
        const double d = glm::distance(lens, glm::dvec3(0.0, 0.0, settings.prop.height_m));
        return min_share_of_brightest / (d * d);
    }
    const LightRange range = light_range(prop, lens, reach_on_table(settings.prop, settings.table));
    return std::max(range.least, min_share_of_brightest * range.most);
}

} // namespace frustumscreen::settings
