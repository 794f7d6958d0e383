#include "app/geometry/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::geometry {

namespace {

constexpr std::size_t leaf_triangles = 4;
/// A balanced tree of 2^32 triangles is no deeper, and each level leaves one node pending.
constexpr std::size_t deepest = 40;
/// A ray through the common edge of two triangles hits one of them despite rounding.
constexpr double on_edge = 1e-9;

/// Boxes are enlarged by this share of the mesh's extent, so that a ray along a box's side is inside it
/// despite rounding.
constexpr float box_margin = 1e-6F;
/// Twice the area over the longest edge's square: a thinner triangle is a rounding artifact of single
/// precision.
constexpr double thinnest = 1e-7;
/// Sine of the angle between ray and triangle below which it is edge-on.
constexpr double edge_on = 1e-12;

bool is_finite(const glm::vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

bool has_area(const std::array<glm::vec3, 3>& corners) {
    if (!std::all_of(corners.begin(), corners.end(), is_finite)) {
        return false;
    }
    const glm::dvec3 a = glm::dvec3(corners[1]) - glm::dvec3(corners[0]);
    const glm::dvec3 b = glm::dvec3(corners[2]) - glm::dvec3(corners[0]);
    const double longest = std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(b - a, b - a)});
    return glm::length(glm::cross(a, b)) > thinnest * longest;
}

/// True if some of the segment's parameters 0..1 lie between the box's slabs. A segment parallel to a slab
/// gives infinities, and NaN if it lies in the slab's boundary; fmin and fmax ignore NaN.
bool passes(const glm::vec3& low, const glm::vec3& high, const glm::dvec3& from, const glm::dvec3& inverse) {
    double first = 0.0;
    double last = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (static_cast<double>(low[axis]) - from[axis]) * inverse[axis];
        const double b = (static_cast<double>(high[axis]) - from[axis]) * inverse[axis];
        first = std::fmax(first, std::fmin(a, b));
        last = std::fmin(last, std::fmax(a, b));
    }
    return first <= last + on_edge;
}

bool meets_triangle(const std::array<glm::vec3, 3>& corners, const glm::dvec3& from, const glm::dvec3& way) {
    const glm::dvec3 origin(corners[0]);
    const glm::dvec3 along_u = glm::dvec3(corners[1]) - origin;
    const glm::dvec3 along_v = glm::dvec3(corners[2]) - origin;
    const glm::dvec3 p = glm::cross(way, along_v);
    const double determinant = glm::dot(along_u, p);
    if (!(std::abs(determinant) > edge_on * glm::length(way) * glm::length(glm::cross(along_u, along_v)))) {
        return false;
    }
    const glm::dvec3 s = from - origin;
    const double u = glm::dot(s, p) / determinant;
    const glm::dvec3 q = glm::cross(s, along_u);
    const double v = glm::dot(way, q) / determinant;
    const double t = glm::dot(along_v, q) / determinant;
    return u >= -on_edge && v >= -on_edge && u + v <= 1.0 + on_edge && t > 0.0 && t < 1.0;
}

} // namespace

TriangleTree::TriangleTree(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices) {
    triangles_.reserve(indices.size() / 3);
    for (std::size_t k = 0; k + 2 < indices.size(); k += 3) {
        const Triangle triangle{
            {positions[indices[k]], positions[indices[k + 1]], positions[indices[k + 2]]}};
        if (has_area(triangle.corners)) {
            triangles_.push_back(triangle);
        }
    }
    if (!triangles_.empty()) {
        nodes_.reserve(triangles_.size());
        float extent = 0.0F;
        for (const Triangle& triangle : triangles_) {
            for (const glm::vec3& corner : triangle.corners) {
                extent = std::max({extent, std::abs(corner.x), std::abs(corner.y), std::abs(corner.z)});
            }
        }
        margin_ = box_margin * extent;
        build(0, triangles_.size());
    }
}

void TriangleTree::build(std::size_t begin, std::size_t end) {
    const std::size_t own = nodes_.size();
    Node node{.low = glm::vec3(std::numeric_limits<float>::infinity()),
              .high = glm::vec3(-std::numeric_limits<float>::infinity()),
              .first = static_cast<std::uint32_t>(begin),
              .count = static_cast<std::uint32_t>(end - begin)};
    for (std::size_t k = begin; k < end; ++k) {
        for (const glm::vec3& corner : triangles_[k].corners) {
            node.low = glm::min(node.low, corner);
            node.high = glm::max(node.high, corner);
        }
    }
    const glm::vec3 size = node.high - node.low;
    node.low -= margin_;
    node.high += margin_;
    nodes_.push_back(node);
    if (end - begin <= leaf_triangles) {
        return;
    }
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto place = [axis](const Triangle& triangle) {
        return triangle.corners[0][axis] + triangle.corners[1][axis] + triangle.corners[2][axis];
    };
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t k) { return triangles_.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(begin), at(middle), at(end),
                     [&](const Triangle& a, const Triangle& b) { return place(a) < place(b); });
    build(begin, middle);
    nodes_[own].first = static_cast<std::uint32_t>(nodes_.size());
    nodes_[own].count = 0;
    build(middle, end);
}

bool TriangleTree::meets(const glm::dvec3& from, const glm::dvec3& to) const {
    if (nodes_.empty()) {
        return false;
    }
    const glm::dvec3 way = to - from;
    const glm::dvec3 inverse = 1.0 / way;
    std::array<std::uint32_t, deepest> later{};
    std::size_t count = 0;
    later[count++] = 0;
    while (count > 0) {
        const std::uint32_t which = later[--count];
        const Node& node = nodes_[which];
        if (!passes(node.low, node.high, from, inverse)) {
            continue;
        }
        if (node.count == 0) {
            later[count++] = node.first;
            later[count++] = which + 1;
            continue;
        }
        for (std::size_t k = node.first; k < node.first + node.count; ++k) {
            if (meets_triangle(triangles_[k].corners, from, way)) {
                return true;
            }
        }
    }
    return false;
}

} // namespace frustumscreen::geometry
