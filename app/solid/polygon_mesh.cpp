#include "app/solid/polygon_mesh.h"

#include <fmt/format.h>

#include <cmath>

namespace frustumscreen::solid {

namespace {

/// Hundredths of a millimetre, without the zeros at the end; minus zero counts as zero.
double rounded_mm(double length_m) {
    return std::round(length_m * 1e5) / 1e2 + 0.0;
}

} // namespace

std::vector<glm::dvec3> corners_of(const PolygonMesh& mesh, const Polygon& polygon) {
    std::vector<glm::dvec3> corners;
    corners.reserve(polygon.corners.size());
    for (const std::uint32_t corner : polygon.corners) {
        corners.push_back(mesh.vertices[corner]);
    }
    return corners;
}

std::string place_of(const PolygonMesh& mesh, const Polygon& polygon) {
    return mesh.numbers == PolygonMesh::Numbers::Lines ? fmt::format("the face of line {}", polygon.number)
                                                       : fmt::format("triangle {}", polygon.number);
}

std::string in_mm(const glm::dvec3& point_m) {
    return fmt::format("({}, {}, {}) mm", rounded_mm(point_m.x), rounded_mm(point_m.y),
                       rounded_mm(point_m.z));
}

std::string in_mm(double length_m) {
    const double mm = std::abs(length_m) * 1e3;
    if (mm >= 100.0) {
        return fmt::format("{:.0f} mm", mm);
    }
    return fmt::format("{:.{}f} mm", mm, mm >= 10.0 ? 1 : 2);
}

} // namespace frustumscreen::solid
