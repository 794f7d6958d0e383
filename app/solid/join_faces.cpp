#include "app/solid/join_faces.h"

#include "app/solid/area_vector.h"
#include "app/solid/solid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace frustumscreen::solid {

namespace {

class Joining {
public:
    explicit Joining(const ClosedMesh& closed)
        : distance_(joining_distance(closed)), sliver_m2_(distance_ * closed.size_m),
          neighbours_(closed.mesh.polygons.size()), taken_(closed.mesh.polygons.size()) {
        for (const Polygon& polygon : closed.mesh.polygons) {
            corners_.push_back(corners_of(closed.mesh, polygon));
            areas_.push_back(area_vector(corners_.back()));
        }
        for (const SharedEdge& edge : closed.edges) {
            neighbours_[edge.left].push_back(edge.right);
            neighbours_[edge.right].push_back(edge.left);
        }
    }

    std::vector<JoinedFace> join() {
        std::vector<std::uint32_t> largest_first(areas_.size());
        std::iota(largest_first.begin(), largest_first.end(), 0U);
        std::stable_sort(largest_first.begin(), largest_first.end(), [&](std::uint32_t x, std::uint32_t y) {
            return glm::length(areas_[x]) > glm::length(areas_[y]);
        });
        std::vector<JoinedFace> faces;
        for (const std::uint32_t seed : largest_first) {
            if (!taken_[seed]) {
                faces.push_back(grown_from(seed));
            }
        }
        std::sort(faces.begin(), faces.end(), [](const JoinedFace& x, const JoinedFace& y) {
            return x.polygons.front() < y.polygons.front();
        });
        return faces;
    }

private:
    JoinedFace grown_from(std::uint32_t seed) {
        JoinedFace face;
        face.polygons = {seed};
        taken_[seed] = true;
        constexpr int max_rounds = 8;
        for (int round = 0; round < max_rounds; ++round) {
            face.plane = plane_of(face.polygons);
            if (!grow(face)) {
                break;
            }
        }
        face.plane = plane_of(face.polygons);
        std::sort(face.polygons.begin(), face.polygons.end());
        return face;
    }

    /// Takes the neighbours that lie in the plane, and theirs; false if there is none.
    bool grow(JoinedFace& face) {
        const std::size_t before = face.polygons.size();
        for (std::size_t k = 0; k < face.polygons.size(); ++k) {
            for (const std::uint32_t neighbour : neighbours_[face.polygons[k]]) {
                if (!taken_[neighbour] && lies_in(face.plane, neighbour)) {
                    taken_[neighbour] = true;
                    face.polygons.push_back(neighbour);
                }
            }
        }
        return face.polygons.size() > before;
    }

    [[nodiscard]] bool lies_in(const geometry::Plane& plane, std::uint32_t polygon) const {
        const bool looks_outward = glm::dot(areas_[polygon], plane.normal) > 0.0;
        const bool has_a_side = glm::length(areas_[polygon]) > sliver_m2_;
        return (looks_outward || !has_a_side) &&
               std::all_of(corners_[polygon].begin(), corners_[polygon].end(), [&](const glm::dvec3& corner) {
                   return std::abs(plane.distance(corner)) <= distance_;
               });
    }

    /// In the middle between the corners that lie farthest to its two sides.
    [[nodiscard]] geometry::Plane plane_of(const std::vector<std::uint32_t>& polygons) const {
        glm::dvec3 area(0.0);
        for (const std::uint32_t polygon : polygons) {
            area += areas_[polygon];
        }
        geometry::Plane plane;
        const double length = glm::length(area);
        plane.normal =
            length > 0.0 ? area / length : plane.normal; // a sliver alone; too many faces or not flat
        const glm::dvec3 first = corners_[polygons.front()].front();
        double low = 0.0;
        double high = 0.0;
        for (const std::uint32_t polygon : polygons) {
            for (const glm::dvec3& corner : corners_[polygon]) {
                const double height = glm::dot(plane.normal, corner - first);
                low = std::fmin(low, height);
                high = std::fmax(high, height);
            }
        }
        plane.offset = glm::dot(plane.normal, first) + 0.5 * (low + high);
        return plane;
    }

    double distance_;
    double
        sliver_m2_; ///< a polygon of a smaller area may have corners so close to a line that it has no side
    std::vector<std::vector<std::uint32_t>> neighbours_;
    std::vector<bool> taken_;
    std::vector<std::vector<glm::dvec3>> corners_;
    std::vector<glm::dvec3> areas_;
};

} // namespace

double joining_distance(const ClosedMesh& closed) {
    constexpr double share_of_size = 1e-3;
    return std::fmin(flatness_m, share_of_size * closed.size_m);
}

std::vector<JoinedFace> join_faces(const ClosedMesh& closed) {
    return Joining(closed).join();
}

} // namespace frustumscreen::solid
