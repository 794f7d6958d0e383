#include "tests/simulators/tags/scene_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace frustumscreen::simulators {

namespace {

constexpr double white = 0.9; // paper and prop
constexpr double black = 0.06;
constexpr double table = 0.25;

/// The projector's picture at a place, 0..1: soft shapes, and bars with hard edges like letters.
double shown(const glm::dvec3& table_m) {
    const double soft = 0.5 + 0.3 * std::sin(95.0 * table_m.x + 40.0 * table_m.y) +
                        0.3 * std::sin(-60.0 * table_m.x + 130.0 * table_m.y + 1.0);
    const bool bar = std::sin(700.0 * table_m.x + 300.0 * table_m.y) > 0.2;
    const bool text = std::sin(31.0 * table_m.x - 17.0 * table_m.y) > 0.0;
    return std::clamp(soft * (text && bar ? 0.3 : 1.0), 0.0, 1.0);
}

} // namespace

SceneSurfaces::SceneSurfaces(geometry::PropShape prop, std::vector<tags::PropTag> tags,
                             const SceneLight& light)
    : prop_(std::move(prop)), tags_(std::move(tags)), light_(light) {
    for (const glm::dvec3& corner : prop_.corners) {
        radius_m_ = std::fmax(radius_m_, glm::length(corner));
    }
    for (const tags::PropTag& tag : tags_) {
        printed_.push_back({tag.prop_from_tag.inverse(),
                            tag.size_m / static_cast<double>(tags::black_modules),
                            tags::tag_modules_of(tag.id)});
        radius_m_ = std::fmax(radius_m_, glm::length(tag.prop_from_tag.translation) + tag.size_m);
    }
}

double SceneSurfaces::lit(double reflectance, const glm::dvec3& table_m) const {
    return reflectance * (light_.room + (light_.picture > 0.0 ? light_.picture * shown(table_m) : 0.0));
}

double SceneSurfaces::table_reflectance(const glm::dvec3& table_m) const {
    if (!light_.busy) {
        return table;
    }
    constexpr double square_m = 0.008;
    const auto column = static_cast<std::int64_t>(std::floor(table_m.x / square_m));
    const auto row = static_cast<std::int64_t>(std::floor(table_m.y / square_m));
    // A hash that looks random.
    const auto mixed = static_cast<std::uint64_t>(column * 73856093 ^ row * 19349663) * 2654435761U;
    return 0.1 + 0.5 * static_cast<double>(mixed >> 20 & 255U) / 255.0;
}

double SceneSurfaces::table_brightness(const glm::dvec3& origin_m, const glm::dvec3& direction) const {
    const glm::dvec3 at = origin_m - direction * (origin_m.z / direction.z);
    return lit(table_reflectance(at), at);
}

double SceneSurfaces::brightness(const glm::dvec3& origin_m, const glm::dvec3& direction,
                                 const geometry::RigidTransform& prop_from_table,
                                 const geometry::RigidTransform& table_from_prop) const {
    const glm::dvec3 origin = prop_from_table.point(origin_m);
    const glm::dvec3 along = prop_from_table.direction(direction);
    double nearest = std::numeric_limits<double>::infinity();
    double reflectance = table;
    if (geometry::PropHit hit; geometry::enter(prop_, origin, along, hit)) {
        nearest = hit.t;
        reflectance = white;
    }
    for (const Printed& tag : printed_) {
        const glm::dvec3 from = tag.tag_from_prop.point(origin);
        const glm::dvec3 to = tag.tag_from_prop.direction(along);
        const double t = -from.z / to.z;
        const glm::dvec3 at = from + t * to;
        const double half = 0.5 * static_cast<double>(tags::tag_modules);
        const double column = half + at.x / tag.module_m;
        const double row = half - at.y / tag.module_m;
        const double last = static_cast<double>(tags::tag_modules);
        if (to.z < 0.0 && t < nearest && column >= 0.0 && row >= 0.0 && column < last && row < last) {
            nearest = t;
            const bool is_white =
                tag.modules[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
            reflectance = is_white ? white : black;
        }
    }
    if (!std::isfinite(nearest)) {
        return table_brightness(origin_m, direction);
    }
    return lit(reflectance, table_from_prop.point(origin + nearest * along));
}

} // namespace frustumscreen::simulators
