#include "app/solid/face_outlines.h"

#include "app/solid/solid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>

namespace frustumscreen::solid {

namespace {

using Outline = std::vector<std::uint32_t>;

/// For each face the edges between it and another one: the vertex where one begins, and where it ends.
std::vector<std::multimap<std::uint32_t, std::uint32_t>> borders_of(const ClosedMesh& closed,
                                                                    const std::vector<JoinedFace>& faces) {
    std::vector<std::size_t> face_of(closed.mesh.polygons.size());
    for (std::size_t k = 0; k < faces.size(); ++k) {
        for (const std::uint32_t polygon : faces[k].polygons) {
            face_of[polygon] = k;
        }
    }
    std::vector<std::multimap<std::uint32_t, std::uint32_t>> borders(faces.size());
    for (const SharedEdge& edge : closed.edges) {
        if (face_of[edge.left] != face_of[edge.right]) {
            borders[face_of[edge.left]].emplace(edge.from, edge.to);
            borders[face_of[edge.right]].emplace(edge.to, edge.from);
        }
    }
    return borders;
}

/// The border as one line, from its lowest vertex around the face; shorter than the border if it is not one line.
Outline walk(const std::multimap<std::uint32_t, std::uint32_t>& border) {
    Outline outline;
    for (auto at = border.begin(); at != border.end() && outline.size() < border.size();) {
        outline.push_back(at->first);
        const auto next = border.find(at->second);
        const bool is_end = next == border.end() || border.count(at->second) != 1 || next == border.begin();
        at = is_end ? border.end() : next;
    }
    return outline;
}

double distance_from_line(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 along = b - a;
    return glm::length(glm::cross(along, point - a)) /
           std::fmax(glm::length(along), std::numeric_limits<double>::min());
}

/// Without the vertices between two corners where three faces meet, if they lie on the line between these.
Outline without_vertices_on_edges(const Outline& outline, const std::vector<int>& faces_at,
                                  const std::vector<glm::dvec3>& vertices) {
    const auto is_corner = [&](std::uint32_t vertex) { return faces_at[vertex] > 2; };
    Outline kept;
    const auto first = std::find_if(outline.begin(), outline.end(), is_corner);
    if (first == outline.end()) {
        return kept;
    }
    Outline turned(first, outline.end());
    turned.insert(turned.end(), outline.begin(), first);
    for (std::size_t begin = 0, end = 0; begin < turned.size(); begin = end) {
        end = begin + 1;
        while (end < turned.size() && !is_corner(turned[end])) {
            ++end;
        }
        const glm::dvec3 a = vertices[turned[begin]];
        const glm::dvec3 b = vertices[turned[end % turned.size()]];
        kept.push_back(turned[begin]);
        for (std::size_t k = begin + 1; k < end; ++k) {
            if (distance_from_line(vertices[turned[k]], a, b) > flatness_m) {
                kept.push_back(turned[k]);
            }
        }
    }
    std::rotate(kept.begin(), std::min_element(kept.begin(), kept.end()), kept.end());
    return kept;
}

/// Whether the outline goes round once, counter-clockwise seen against the normal.
bool goes_round_once(const Outline& outline, const glm::dvec3& normal,
                     const std::vector<glm::dvec3>& vertices) {
    double turned = 0.0;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const glm::dvec3 a = vertices[outline[k]];
        const glm::dvec3 b = vertices[outline[(k + 1) % outline.size()]];
        const glm::dvec3 c = vertices[outline[(k + 2) % outline.size()]];
        turned += std::atan2(glm::dot(normal, glm::cross(b - a, c - b)), glm::dot(b - a, c - b));
    }
    return std::abs(turned - 2.0 * std::numbers::pi) < 0.1;
}

} // namespace

Result<std::vector<Outline>> face_outlines(const ClosedMesh& closed, const std::vector<JoinedFace>& faces,
                                           const std::vector<std::string>& names) {
    const std::vector<std::multimap<std::uint32_t, std::uint32_t>> borders = borders_of(closed, faces);
    std::vector<Outline> outlines;
    std::vector<int> faces_at(closed.mesh.vertices.size());
    for (std::size_t k = 0; k < faces.size(); ++k) {
        outlines.push_back(walk(borders[k]));
        if (outlines.back().size() != borders[k].size()) {
            return bad_input(
                "prop_file.outline",
                "{} has a hole, or touches itself at a corner; a face has one outline: close the "
                "hole, or draw the face as two",
                names[k]);
        }
        for (const std::uint32_t vertex : outlines.back()) {
            ++faces_at[vertex];
        }
    }
    for (std::size_t k = 0; k < faces.size(); ++k) {
        outlines[k] = without_vertices_on_edges(outlines[k], faces_at, closed.mesh.vertices);
        if (outlines[k].size() < 3 ||
            !goes_round_once(outlines[k], faces[k].plane.normal, closed.mesh.vertices)) {
            return bad_input(
                "prop_file.crossing",
                "the outline of {} crosses itself, or is thinner than {}; draw its corners in their "
                "order around the face",
                names[k], in_mm(flatness_m));
        }
    }
    return outlines;
}

} // namespace frustumscreen::solid
