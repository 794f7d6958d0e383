#include "app/geometry/convex_hull.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <utility>

namespace frustumscreen::geometry {

namespace {

/// A point nearer to a face than this share of the cloud's size counts as on it.
constexpr double on_face_share = 1e-10;
constexpr double flat_share = 1e-7;

struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
};

Box box_around(std::span<const glm::dvec3> points) {
    Box box;
    for (const glm::dvec3& point : points) {
        box.low = glm::min(box.low, point);
        box.high = glm::max(box.high, point);
    }
    return box;
}

std::vector<glm::dvec3> corners_of(const Box& box) {
    std::vector<glm::dvec3> corners;
    for (unsigned k = 0; k < 8; ++k) {
        corners.emplace_back((k & 1U) != 0 ? box.high.x : box.low.x, (k & 2U) != 0 ? box.high.y : box.low.y,
                             (k & 4U) != 0 ? box.high.z : box.low.z);
    }
    return corners;
}

class Quickhull {
public:
    Quickhull(std::span<const glm::dvec3> points, double size)
        : points_(points), on_face_(on_face_share * size) {}

    /// False if all points lie on a plane, whose unit normal is then in `flat`, or on a line, which leaves
    /// `flat` empty.
    bool begin(double size, std::optional<glm::dvec3>& flat) {
        const std::size_t a = farthest([&](const glm::dvec3& p) { return -p.x - 0.1 * p.y - 0.01 * p.z; });
        const std::size_t b = farthest([&](const glm::dvec3& p) { return glm::distance(p, points_[a]); });
        const glm::dvec3 along = points_[b] - points_[a];
        const auto from_line = [&](const glm::dvec3& p) {
            return glm::length(glm::cross(along, p - points_[a]));
        };
        const std::size_t c = farthest(from_line);
        if (!(from_line(points_[c]) > flat_share * size * size)) {
            return false;
        }
        const glm::dvec3 normal = glm::normalize(glm::cross(along, points_[c] - points_[a]));
        const auto from_plane = [&](const glm::dvec3& p) {
            return std::abs(glm::dot(normal, p - points_[a]));
        };
        const std::size_t d = farthest(from_plane);
        if (!(from_plane(points_[d]) > flat_share * size)) {
            flat = normal;
            return false;
        }
        const bool before = glm::dot(normal, points_[d] - points_[a]) > 0.0;
        const std::array<std::size_t, 3> foot = before ? std::array{a, c, b} : std::array{a, b, c};
        std::vector<std::size_t> all(points_.size());
        for (std::size_t k = 0; k < all.size(); ++k) {
            all[k] = k;
        }
        corners_ = 4;
        std::vector<Face> faces{make(foot[0], foot[1], foot[2])};
        for (std::size_t k = 0; k < 3; ++k) {
            faces.push_back(make(foot[(k + 1) % 3], foot[k], d));
        }
        adopt(std::move(faces), all);
        return true;
    }

    /// Adds corners until no point lies outside, or there are `most` corners.
    void grow(std::size_t most) {
        while (corners_ < most) {
            const auto widest = std::max_element(
                faces_.begin(), faces_.end(), [](const Face& x, const Face& y) { return x.most < y.most; });
            if (!(widest->most > on_face_)) {
                return;
            }
            add(widest->farthest);
        }
    }

    /// The corners, moved away from their middle until the solid holds all points.
    [[nodiscard]] std::vector<glm::dvec3> enclosing() const {
        std::vector<std::size_t> used;
        for (const Face& face : faces_) {
            used.insert(used.end(), face.corners.begin(), face.corners.end());
        }
        std::sort(used.begin(), used.end());
        used.erase(std::unique(used.begin(), used.end()), used.end());
        glm::dvec3 middle(0.0);
        for (const std::size_t corner : used) {
            middle += points_[corner] / static_cast<double>(used.size());
        }
        double scale = 1.0;
        for (const Face& face : faces_) {
            const double distance = face.offset - glm::dot(face.normal, middle);
            for (const Face& with : faces_) {
                for (const std::size_t point : with.outside) {
                    scale = std::fmax(scale, (distance + before(face, point)) / distance);
                }
            }
        }
        std::vector<glm::dvec3> corners;
        corners.reserve(used.size());
        for (const std::size_t corner : used) {
            corners.push_back(middle + scale * (points_[corner] - middle));
        }
        return corners;
    }

private:
    struct Face {
        std::array<std::size_t, 3> corners{};
        glm::dvec3 normal{0.0}; ///< unit, outward
        double offset = 0.0;
        std::vector<std::size_t> outside; ///< points before this face and no other
        double most = 0.0;                ///< distance of the farthest of them
        std::size_t farthest = 0;
    };

    template <typename Measure> [[nodiscard]] std::size_t farthest(const Measure& measure) const {
        std::size_t best = 0;
        for (std::size_t k = 1; k < points_.size(); ++k) {
            best = measure(points_[k]) > measure(points_[best]) ? k : best;
        }
        return best;
    }
    [[nodiscard]] Face make(std::size_t a, std::size_t b, std::size_t c) const {
        Face face;
        face.corners = {a, b, c};
        const glm::dvec3 across = glm::cross(points_[b] - points_[a], points_[c] - points_[a]);
        face.normal = across / std::fmax(glm::length(across), std::numeric_limits<double>::min());
        face.offset = glm::dot(face.normal, points_[a]);
        return face;
    }
    [[nodiscard]] double before(const Face& face, std::size_t point) const {
        return glm::dot(face.normal, points_[point]) - face.offset;
    }
    /// Assigns each point to the face that it lies farthest in front of.
    void adopt(std::vector<Face> faces, std::span<const std::size_t> points) {
        for (const std::size_t point : points) {
            Face* best = nullptr;
            double most = on_face_;
            for (Face& face : faces) {
                if (const double distance = before(face, point); distance > most) {
                    most = distance;
                    best = &face;
                }
            }
            if (best != nullptr) {
                best->outside.push_back(point);
                best->farthest = most > best->most ? point : best->farthest;
                best->most = std::fmax(best->most, most);
            }
        }
        std::move(faces.begin(), faces.end(), std::back_inserter(faces_));
    }
    /// Replaces the faces that see the point by faces between it and their border.
    void add(std::size_t point) {
        std::set<std::pair<std::size_t, std::size_t>> edges; // of the replaced faces, each in its direction
        std::vector<std::size_t> homeless;
        std::vector<Face> stay;
        for (Face& face : faces_) {
            if (before(face, point) <= on_face_) {
                stay.push_back(std::move(face));
                continue;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                edges.emplace(face.corners[k], face.corners[(k + 1) % 3]);
            }
            homeless.insert(homeless.end(), face.outside.begin(), face.outside.end());
        }
        faces_ = std::move(stay);
        std::vector<Face> fresh;
        for (const auto& [from, to] : edges) {
            if (edges.count({to, from}) == 0) {
                fresh.push_back(make(from, to, point));
            }
        }
        ++corners_;
        adopt(std::move(fresh), homeless);
    }

    std::span<const glm::dvec3> points_;
    double on_face_;
    std::vector<Face> faces_;
    std::size_t corners_ = 0;
};

} // namespace

namespace {

/// Coordinates in which a cloud extends about equally in every direction, so that scaling grows it by the
/// same share in each.
struct Evened {
    glm::dvec3 mean{0.0};
    glm::dmat3 cloud_from_even{1.0}; ///< lower triangular
    bool regular = false;            ///< the points do not lie on a plane

    explicit Evened(std::span<const glm::dvec3> points) {
        const double share = 1.0 / static_cast<double>(points.size());
        for (const glm::dvec3& point : points) {
            mean += share * point;
        }
        glm::dmat3 spread(0.0);
        for (const glm::dvec3& point : points) {
            spread += share * glm::outerProduct(point - mean, point - mean);
        }
        // Cholesky: spread = L L^T.
        glm::dmat3 l(0.0);
        const double size2 = spread[0][0] + spread[1][1] + spread[2][2];
        for (int column = 0; column < 3; ++column) {
            for (int row = column; row < 3; ++row) {
                double rest = spread[column][row];
                for (int k = 0; k < column; ++k) {
                    rest -= l[k][row] * l[k][column];
                }
                if (row == column && !(rest > flat_share * flat_share * size2)) {
                    return;
                }
                l[column][row] = row == column ? std::sqrt(rest) : rest / l[column][column];
            }
        }
        cloud_from_even = l;
        regular = true;
    }
};

/// Nothing if the points lie on a plane; its normal is then in `flat`, which stays empty if they lie on a
/// line.
std::optional<std::vector<glm::dvec3>> solid_around(std::span<const glm::dvec3> points, std::size_t most,
                                                    std::optional<glm::dvec3>& flat) {
    const Box box = box_around(points);
    const glm::dvec3 extent = box.high - box.low;
    const double size = std::max({extent.x, extent.y, extent.z});
    Quickhull hull(points, size);
    if (!hull.begin(size, flat)) {
        return std::nullopt;
    }
    hull.grow(most);
    return hull.enclosing();
}

} // namespace

std::vector<glm::dvec3> enclosing_corners(std::span<const glm::dvec3> points, std::size_t most) {
    assert(!points.empty() && most >= 8);
    const Box box = box_around(points);
    if (box.low == box.high) {
        return {points.front()};
    }
    std::optional<glm::dvec3> flat;
    if (const Evened evened(points); evened.regular) {
        const glm::dmat3 even_from_cloud = glm::inverse(evened.cloud_from_even);
        std::vector<glm::dvec3> even;
        even.reserve(points.size());
        for (const glm::dvec3& point : points) {
            even.push_back(even_from_cloud * (point - evened.mean));
        }
        if (std::optional<std::vector<glm::dvec3>> corners = solid_around(even, most, flat)) {
            for (glm::dvec3& corner : *corners) {
                corner = evened.mean + evened.cloud_from_even * corner;
            }
            return *corners;
        }
    }
    flat.reset();
    if (const std::optional<std::vector<glm::dvec3>> corners = solid_around(points, most, flat)) {
        return *corners;
    }
    if (!flat) {
        return corners_of(box);
    }
    // A flat cloud gets an invisible thickness.
    const glm::dvec3 extent = box.high - box.low;
    const double thickness = 10.0 * flat_share * std::max({extent.x, extent.y, extent.z});
    std::vector<glm::dvec3> thick(points.begin(), points.end());
    for (const glm::dvec3& point : points) {
        thick.push_back(point + thickness * *flat);
    }
    return solid_around(thick, most, flat).value_or(corners_of(box));
}

} // namespace frustumscreen::geometry
