#include "app/bench/torch/drawn_surface.h"

#include "assets_baked/bake/relief_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace frustumscreen::bench {

namespace {

bake::TriangleMesh mesh_of(const scene::LevelTriangles& level) {
    return {.positions = level.positions, .indices = level.indices};
}

glm::dvec3 unit_or_zero(const glm::dvec3& vector) {
    const double length = glm::length(vector);
    return length > 0.0 ? vector / length : glm::dvec3(0.0);
}

bool meets(const geometry::Box& box, const glm::dvec3& origin, const glm::dvec3& direction) {
    double from = 0.0;
    double to = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (box.low[axis] - origin[axis]) / direction[axis];
        const double b = (box.high[axis] - origin[axis]) / direction[axis];
        if (std::isnan(a) || std::isnan(b)) { // along a side of the box
            continue;
        }
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    return from <= to;
}

} // namespace

struct DrawnSurface::Solid {
    explicit Solid(const scene::PlacedLevel& placed)
        : prop_from_box(placed.prop_from_box()), box_from_prop(glm::inverse(prop_from_box)) {
        if (placed.relief) {
            relief.emplace(*placed.relief);
        } else if (placed.triangles) {
            mesh = bake::as_source(mesh_of(*placed.triangles));
            scene.emplace(mesh, mesh.positions);
        }
        const glm::dvec3 extent = placed.box_size;
        constexpr double margin = 1e-4;
        box = {glm::dvec3(-0.5 * extent.x, -0.5 * extent.y, 0.0) - margin,
               glm::dvec3(0.5 * extent.x, 0.5 * extent.y, extent.z) + margin};
    }

    glm::dmat4 prop_from_box, box_from_prop;
    geometry::Box box;
    bake::SourceMesh mesh;
    std::optional<bake::SourceScene> scene;
    std::optional<bake::ReliefScene> relief;
};

DrawnSurface::DrawnSurface(std::span<const scene::Part> parts) {
    for (const scene::Part& part : parts) {
        if (!part.level.is_empty()) {
            solids_.push_back(std::make_unique<const Solid>(part.level));
        }
    }
}
DrawnSurface::~DrawnSurface() = default;
DrawnSurface::DrawnSurface(DrawnSurface&&) noexcept = default;

DrawnSurface::Hit DrawnSurface::first_hit(const glm::dvec3& origin, const glm::dvec3& direction) const {
    Hit first;
    for (const std::unique_ptr<const Solid>& solid : solids_) {
        const glm::dvec3 from(solid->box_from_prop * glm::dvec4(origin, 1.0));
        const glm::dvec3 towards = glm::normalize(glm::dmat3(solid->box_from_prop) * direction);
        if (!meets(solid->box, from, towards)) {
            continue;
        }
        const bake::SurfaceHit hit = solid->relief ? solid->relief->trace(glm::vec3(from), glm::vec3(towards))
                                                   : solid->scene->trace(glm::vec3(from), glm::vec3(towards));
        if (!hit.hit) {
            continue;
        }
        const glm::dvec3 point(solid->prop_from_box *
                               glm::dvec4(from + static_cast<double>(hit.distance) * towards, 1.0));
        const double distance_m = glm::distance(point, origin);
        if (!first.hit || distance_m < first.distance_m) {
            const glm::dmat3 normals = glm::transpose(glm::dmat3(solid->box_from_prop));
            first = {true, distance_m, point, unit_or_zero(normals * glm::dvec3(hit.normal))};
        }
    }
    return first;
}

} // namespace frustumscreen::bench
