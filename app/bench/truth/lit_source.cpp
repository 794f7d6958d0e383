#include "app/bench/truth/lit_source.h"

#include "assets_baked/bake/box_frame.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

namespace frustumscreen::bench {

namespace {

/// Area-weighted sums of the triangles' normals, over all that meet at a position, whether or not they share
/// a vertex there.
std::vector<glm::dvec3> smooth_normals(const bake::SourceMesh& mesh, const std::vector<glm::dvec3>& points) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto key = [&](std::size_t k) { return std::tuple(points[k].x, points[k].y, points[k].z); };
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    std::vector<std::size_t> first(points.size()); // first vertex at the same position
    for (std::size_t k = 0; k < order.size(); ++k) {
        const bool same = k > 0 && points[order[k]] == points[order[k - 1]];
        first[order[k]] = same ? first[order[k - 1]] : order[k];
    }
    std::vector<glm::dvec3> sums(points.size(), glm::dvec3(0.0));
    for (const std::array<std::uint32_t, 3>& corners : mesh.triangles) {
        const glm::dvec3& a = points[corners[0]];
        const glm::dvec3 normal = glm::cross(points[corners[1]] - a, points[corners[2]] - a);
        for (const std::uint32_t corner : corners) {
            sums[first[corner]] += normal;
        }
    }
    std::vector<glm::dvec3> normals(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
        const double length = glm::length(sums[first[k]]);
        normals[k] = length > 0.0 ? sums[first[k]] / length : glm::dvec3(0.0);
    }
    return normals;
}

} // namespace

LitSource::LitSource(std::shared_ptr<const bake::SourceMesh> mesh, const glm::dmat4& box_from_file)
    : mesh_(std::move(mesh)), points_(bake::in_box(*mesh_, box_from_file)),
      normals_(smooth_normals(*mesh_, points_)), scene_(*mesh_, points_), museum_(scene_) {}

LitSource::Place LitSource::place(std::uint32_t triangle, double u, double v,
                                  const glm::dvec3& direction) const {
    const std::array<std::uint32_t, 3>& corners = mesh_->triangles[triangle];
    const auto blend = [&](const std::vector<glm::dvec3>& values) {
        return (1.0 - u - v) * values[corners[0]] + u * values[corners[1]] + v * values[corners[2]];
    };
    const glm::dvec3 flat = glm::normalize(
        glm::cross(points_[corners[1]] - points_[corners[0]], points_[corners[2]] - points_[corners[0]]));
    const glm::dvec3 smooth = blend(normals_);
    // Across a sharp edge the smooth normal belongs to neither side.
    const bool is_edge = !(glm::dot(smooth, flat) > 0.5 * glm::length(smooth));
    const glm::dvec3 normal = is_edge ? flat : glm::normalize(smooth);
    return {blend(points_), glm::dot(flat, direction) > 0.0 ? -normal : normal};
}

} // namespace frustumscreen::bench
