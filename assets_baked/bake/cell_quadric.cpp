#include "assets_baked/bake/cell_quadric.h"

namespace frustumscreen::bake {

void CellQuadric::add_plane(const glm::vec3& normal, const glm::vec3& on_plane) {
    const float area = glm::length(normal);
    if (!(area > 0.0F)) {
        return;
    }
    const glm::vec3 unit = normal / area;
    diagonal_ += area * unit * unit;
    mixed_ += area * glm::vec3(unit.y * unit.z, unit.x * unit.z, unit.x * unit.y);
    towards_ += area * glm::dot(unit, on_plane) * unit;
}

void CellQuadric::add_vertex(const glm::vec3& position) {
    sum_ += position;
    count_ += 1.0F;
}

glm::vec3 CellQuadric::best() const {
    // The weight of the mean relative to the planes'. It moves an edge of a right angle by a few thousandths of the
    // vertices' spread, and decides alone along a plane, whose curvature has less weight.
    constexpr double mean_weight = 1e-3;
    const glm::dvec3 mean = glm::dvec3(sum_) / static_cast<double>(count_ > 0.0F ? count_ : 1.0F);
    const double total = static_cast<double>(diagonal_.x + diagonal_.y + diagonal_.z);
    if (!(total > 0.0)) {
        return glm::vec3(mean);
    }
    const glm::dvec3 d = glm::dvec3(diagonal_) / total + mean_weight;
    const glm::dvec3 m = glm::dvec3(mixed_) / total;
    const glm::dmat3 planes(glm::dvec3(d.x, m.z, m.y), glm::dvec3(m.z, d.y, m.x), glm::dvec3(m.y, m.x, d.z));
    const glm::dvec3 point = glm::inverse(planes) * (glm::dvec3(towards_) / total + mean_weight * mean);
    return glm::clamp(glm::vec3(point), glm::vec3(-0.5F), glm::vec3(0.5F));
}

} // namespace frustumscreen::bake
