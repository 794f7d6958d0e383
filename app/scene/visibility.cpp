#include "app/scene/visibility.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace frustumscreen::scene {

namespace {

/// Profile around the part of a ball that lies between two radii and above an elevation.
std::vector<glm::dvec2> shell(double nearest, double farthest, double lowest_elevation) {
    constexpr int tangents = 32;
    const double step = (std::numbers::pi / 2.0 - lowest_elevation) / tangents;
    const auto at = [](double radius, double elevation) {
        return radius * glm::dvec2(std::cos(elevation), std::sin(elevation));
    };
    std::vector<glm::dvec2> profile{at(nearest, lowest_elevation), at(farthest, lowest_elevation),
                                    at(nearest, std::numbers::pi / 2.0),
                                    at(farthest, std::numbers::pi / 2.0)};
    for (int k = 0; k < tangents; ++k) { // where tangents to the arc meet
        profile.push_back(at(farthest / std::cos(step / 2.0), lowest_elevation + (k + 0.5) * step));
    }
    return profile;
}

/// A point of the table frame, relative to a prop that stands anywhere on the table at any yaw.
PointZone seen_from_the_table(const settings::TableSettings& table, const glm::dvec3& point) {
    const glm::dvec2 half(table.width_m / 2.0, table.depth_m / 2.0);
    const glm::dvec2 farthest = glm::abs(glm::dvec2(point)) + half;
    return {false, {}, {{glm::length(farthest), point.z}}};
}

} // namespace

double PointZone::reach(const glm::dvec3& direction) const {
    if (anywhere) {
        return std::numeric_limits<double>::infinity();
    }
    double most = -std::numeric_limits<double>::infinity();
    for (const glm::dvec3& point : points) {
        most = std::fmax(most, glm::dot(direction, point));
    }
    const double outward = glm::length(glm::dvec2(direction));
    for (const glm::dvec2& ring : rings) {
        most = std::fmax(most, outward * ring.x + direction.z * ring.y);
    }
    return most + margin_m * glm::length(direction);
}

double PointZone::farthest() const {
    double most = anywhere ? std::numeric_limits<double>::infinity() : 0.0;
    for (const glm::dvec3& point : points) {
        most = std::fmax(most, glm::length(point));
    }
    for (const glm::dvec2& ring : rings) {
        most = std::fmax(most, glm::length(ring));
    }
    return most + margin_m;
}

Visibility visibility_of(const settings::Settings& settings, std::vector<KnownView> views) {
    Visibility visibility;
    visibility.eyes.anywhere = false;
    visibility.lens.anywhere = false;
    for (const KnownView& view : views) {
        const geometry::RigidTransform prop_from_table = view.table_from_prop.inverse();
        visibility.eyes.points.push_back(prop_from_table.point(view.eye_m));
        visibility.lens.points.push_back(
            prop_from_table.point(settings.projector.table_from_projector.translation));
    }
    visibility.views = std::move(views);
    return visibility;
}

Visibility visibility_of(const settings::Settings& settings) {
    const bool fixed_prop = settings.tracker.kind == settings::TrackerKind::None;
    const settings::EyeSettings& eye = settings.eye;
    const glm::dvec3& lens = settings.projector.table_from_projector.translation;
    const bool upright = settings.tracker.kind == settings::TrackerKind::Simulated &&
                         settings.prop.zone == settings::PropZone::Table;
    if (!fixed_prop && !upright) { // it may be lifted and tilted
        return {};
    }
    const bool stereo = settings::stereo_of(settings) != settings::Stereo::Off;
    if (fixed_prop && !eye.tracked && !stereo) {
        return visibility_of(settings, {KnownView{{}, eye.default_m}});
    }
    Visibility visibility;
    visibility.eyes = seen_from_the_table(settings.table, eye.default_m);
    if (eye.tracked) {
        // Without a tracked head the eye is the default one, which need not lie in the zone.
        const std::vector<glm::dvec2> zone =
            shell(eye.nearest_m, eye.farthest_m, glm::radians(eye.lowest_elevation_deg));
        visibility.eyes.rings.insert(visibility.eyes.rings.end(), zone.begin(), zone.end());
    }
    visibility.eyes.margin_m = stereo ? 0.5e-3 * eye.interocular_mm : 0.0;
    visibility.lens = fixed_prop ? PointZone{false, {lens}, {}} : seen_from_the_table(settings.table, lens);
    return visibility;
}

} // namespace frustumscreen::scene
