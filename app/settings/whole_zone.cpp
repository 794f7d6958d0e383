#include "app/settings/whole_zone.h"

#include "app/geometry/picture_planes.h"
#include "app/settings/lit_zone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace frustumscreen::settings {

namespace {

/// The distance from the lens's foot up to which every face is turned to the light at every yaw, by FaceReader's
/// criterion: the sine at the farthest corner. Negative if there is none. Compare radius_lit_at_foot in lit_zone.cpp.
double radius_lit_at_farthest_corner(const geometry::PropShape& prop, const glm::dvec3& lens) {
    double reach = 0.0;
    for (const glm::dvec3& corner : prop.corners) {
        reach = std::fmax(reach, glm::length(corner));
    }
    const auto lit = [&](double radius) {
        const double farthest = std::hypot(radius, lens.z) + reach;
        return std::all_of(prop.faces.begin(), prop.faces.end(), [&](const geometry::PropFace& face) {
            const glm::dvec3& n = face.plane.normal;
            const double height = n.z * lens.z - face.plane.offset - glm::length(glm::dvec2(n)) * radius;
            return height >= min_sine_of_light * farthest;
        });
    };
    if (!lit(0.0)) {
        return -1.0;
    }
    double inside = 0.0;
    double outside = 100.0;
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (inside + outside);
        (lit(middle) ? inside : outside) = middle;
    }
    return inside;
}

/// The table top without a rim. A prop stands firmly if its axis is at least half its foot's reach from the table's
/// edge; a corner of the foot may then extend beyond the edge.
Polygon places_on_table(const TableSettings& table, const geometry::PropShape& prop) {
    double rim = 0.0;
    for (const glm::dvec3& corner : prop.corners) {
        rim = std::fmax(rim, 0.5 * glm::length(glm::dvec2(corner)));
    }
    const double x = 0.5 * table.width_m - rim;
    const double y = 0.5 * table.depth_m - rim;
    return x > 0.0 && y > 0.0 ? Polygon{{-x, -y}, {x, -y}, {x, y}, {-x, y}} : Polygon();
}

} // namespace

WholeZone whole_zone(const Settings& settings, const EyesAround& eyes, std::span<const glm::dvec3> hull) {
    if (settings.prop.zone == PropZone::Hand) {
        const LitZone lit = lit_zone(settings);
        return {lit.any_eye, lit.any_eye_rectangle};
    }
    const geometry::PropShape prop = make_prop(settings.prop);
    const glm::dvec3 lens = settings.projector.table_from_projector.translation;
    const double radius = radius_lit_at_farthest_corner(prop, lens);
    Polygon places = radius > 0.0 ? places_on_table(settings.table, prop) : Polygon();
    // The circle about the prop's axis through which the artifact is seen must lie in the picture.
    const std::array<geometry::Plane, 4> picture =
        geometry::picture_planes(settings.projector.pinhole, settings.projector.table_from_projector);
    for (const glm::dvec2& round : seen_extent(prop, eyes, hull)) {
        for (const geometry::Plane& edge : picture) {
            const glm::dvec2 inward(edge.normal);
            places = clipped(places,
                             {inward, edge.offset - edge.normal.z * round.y + glm::length(inward) * round.x});
        }
    }
    // The disc as an inscribed polygon: never too large, too small by 0.02 % at most.
    constexpr int sides = 180;
    const double apothem = radius * std::cos(std::numbers::pi / sides);
    for (int side = 0; side < sides; ++side) {
        const double azimuth = 2.0 * std::numbers::pi * side / sides;
        const glm::dvec2 inward(-std::cos(azimuth), -std::sin(azimuth));
        places = clipped(places, {inward, glm::dot(inward, glm::dvec2(lens)) - apothem});
    }
    if (places.size() < 3 || !(area_of(places) > 0.0)) {
        return {};
    }
    return {places, rectangle_inside(places)};
}

std::vector<glm::dvec3> usual_artifact(const geometry::PropShape& prop) {
    constexpr int around = 16;
    constexpr int rings = 8;
    constexpr double half_width = 0.325; // of a height of 1
    std::vector<glm::dvec3> corners{{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
    for (int ring = 1; ring < rings; ++ring) {
        const double latitude = std::numbers::pi * (static_cast<double>(ring) / rings - 0.5);
        for (int k = 0; k < around; ++k) {
            const double azimuth = 2.0 * std::numbers::pi * k / around;
            const double across = half_width * std::cos(latitude);
            corners.emplace_back(across * std::cos(azimuth), across * std::sin(azimuth),
                                 0.5 + 0.5 * std::sin(latitude));
        }
    }
    const double scale = geometry::largest_scale_inside(prop, corners);
    for (glm::dvec3& corner : corners) {
        corner *= scale;
    }
    return corners;
}

} // namespace frustumscreen::settings
