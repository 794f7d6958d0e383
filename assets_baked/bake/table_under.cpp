#include "assets_baked/bake/table_under.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

namespace frustumscreen::bake {

namespace {

constexpr std::size_t min_triangles = 100;
constexpr std::size_t max_sampled = 100'000; ///< triangles that vote for a plane
constexpr std::size_t candidates = 64;
constexpr double flatness = 0.004; ///< of the scan's size: how far a table's triangles may lie from its plane
constexpr double max_lean = 0.97;  ///< cosine between a triangle's normal and the plane's
constexpr double min_table_area = 0.05; ///< of the area
constexpr double max_on_both = 0.02;    ///< of the other area: what may lie on the table's far side
constexpr double min_reach = 0.15;      ///< of the object's width, on the average over all sides
constexpr double min_height = 0.25;     ///< of the object's width: a relief on its ground is flatter
constexpr std::size_t sides = 16;

struct Plane {
    glm::dvec3 normal{0.0};
    double offset = 0.0;
    [[nodiscard]] double distance(const glm::dvec3& p) const { return glm::dot(normal, p) - offset; }
};

struct Facet {
    std::array<glm::dvec3, 3> corners;
    glm::dvec3 normal; ///< of length 2 * area
    [[nodiscard]] double area() const { return 0.5 * glm::length(normal); }
    [[nodiscard]] glm::dvec3 middle() const { return (corners[0] + corners[1] + corners[2]) / 3.0; }
};

class Facets {
public:
    Facets(const SourceMesh& mesh, const Scraps& ignored) : mesh_(mesh), ignored_(ignored) {}
    [[nodiscard]] std::size_t count() const { return mesh_.triangles.size(); }
    [[nodiscard]] bool counts(std::size_t t) const {
        return ignored_.is_scrap.empty() || !ignored_.is_scrap[t];
    }
    [[nodiscard]] Facet at(std::size_t t) const {
        const auto& [a, b, c] = mesh_.triangles[t];
        const std::array corners{mesh_.positions[a], mesh_.positions[b], mesh_.positions[c]};
        return {corners, glm::cross(corners[1] - corners[0], corners[2] - corners[0])};
    }

private:
    const SourceMesh& mesh_;
    const Scraps& ignored_;
};

struct Extents {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
    void add(const Facet& facet) {
        for (const glm::dvec3& corner : facet.corners) {
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
    }
    [[nodiscard]] double longest() const {
        const glm::dvec3 edges = high - low;
        return std::max({edges.x, edges.y, edges.z, 0.0});
    }
};

bool lies_in(const Plane& plane, const Facet& facet, double tolerance) {
    return std::abs(glm::dot(plane.normal, facet.normal)) >= max_lean * glm::length(facet.normal) &&
           std::all_of(facet.corners.begin(), facet.corners.end(), [&](const glm::dvec3& corner) {
               return std::abs(plane.distance(corner)) <= tolerance;
           });
}

/// Every so many triangles, so that no more than max_sampled are.
std::vector<Facet> sampled(const Facets& facets) {
    std::vector<Facet> some;
    const std::size_t step = (facets.count() + max_sampled - 1) / max_sampled;
    for (std::size_t t = 0; t < facets.count(); t += step) {
        if (facets.counts(t)) {
            some.push_back(facets.at(t));
        }
    }
    return some;
}

struct Votes {
    double area = 0.0;
    glm::dvec3 normal{0.0}, middle{0.0}; ///< weighted by area
};

Votes votes_for(const Plane& plane, const std::vector<Facet>& facets, double tolerance) {
    Votes votes;
    for (const Facet& facet : facets) {
        if (lies_in(plane, facet, tolerance)) {
            const double area = facet.area();
            votes.area += area;
            votes.normal += glm::dot(facet.normal, plane.normal) < 0.0 ? -facet.normal : facet.normal;
            votes.middle += area * facet.middle();
        }
    }
    return votes;
}

Plane through(const glm::dvec3& normal, const glm::dvec3& point) {
    const glm::dvec3 unit = glm::normalize(normal);
    return {unit, glm::dot(unit, point)};
}

/// The plane that holds most of the area; nothing if none holds much.
std::optional<Plane> widest_plane(const std::vector<Facet>& facets, double tolerance) {
    double all = 0.0;
    for (const Facet& facet : facets) {
        all += facet.area();
    }
    if (!(all > 0.0)) {
        return std::nullopt;
    }
    Plane best;
    double best_area = 0.0;
    double passed = 0.0;
    std::size_t next = 0;
    for (const Facet& facet : facets) {
        passed += facet.area();
        if (facet.area() <= 0.0 || passed < (static_cast<double>(next) + 0.5) / candidates * all) {
            continue;
        }
        next = static_cast<std::size_t>(passed / all * candidates + 0.5);
        Plane plane = through(facet.normal, facet.middle());
        for (int fit = 0; fit < 2; ++fit) { // once more through all that it holds
            const Votes votes = votes_for(plane, facets, tolerance);
            if (votes.area > best_area) {
                best_area = votes.area;
                best = plane;
            }
            if (votes.area > 0.0) {
                plane = through(votes.normal, votes.middle / votes.area);
            }
        }
    }
    return best_area >= min_table_area * all ? std::optional(best) : std::nullopt;
}

/// Turns the plane's normal to the side where the rest lies; nothing if it lies on both.
std::optional<Plane> towards_rest(Plane plane, const std::vector<Facet>& facets, double tolerance) {
    double above = 0.0;
    double below = 0.0;
    for (const Facet& facet : facets) {
        const double distance = plane.distance(facet.middle());
        (distance > 0.0 ? above : below) += std::abs(distance) > tolerance ? facet.area() : 0.0;
    }
    if (std::min(above, below) > max_on_both * (above + below) || above + below <= 0.0) {
        return std::nullopt;
    }
    return above > below ? plane : Plane{-plane.normal, -plane.offset};
}

/// How far something reaches to each side, along the plane.
class Reach {
public:
    explicit Reach(const Plane& plane) {
        const glm::dvec3 other = std::abs(plane.normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        const glm::dvec3 u = glm::normalize(glm::cross(plane.normal, other));
        const glm::dvec3 v = glm::cross(plane.normal, u);
        for (std::size_t k = 0; k < sides; ++k) {
            const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / sides;
            directions_[k] = std::cos(angle) * u + std::sin(angle) * v;
        }
        farthest_.fill(-std::numeric_limits<double>::infinity());
    }
    void add(const Facet& facet) {
        for (std::size_t k = 0; k < sides; ++k) {
            for (const glm::dvec3& corner : facet.corners) {
                farthest_[k] = std::max(farthest_[k], glm::dot(directions_[k], corner));
            }
        }
    }
    /// Mean width over all directions. The directions sum to zero, so the origin cancels out.
    [[nodiscard]] double width() const {
        return 2.0 / sides * std::accumulate(farthest_.begin(), farthest_.end(), 0.0);
    }
    /// Whether it reaches beyond `object` on all sides, and far enough.
    [[nodiscard]] bool is_around(const Reach& object) const {
        double beyond = 0.0;
        for (std::size_t k = 0; k < sides; ++k) {
            if (!(farthest_[k] > object.farthest_[k])) {
                return false;
            }
            beyond += (farthest_[k] - object.farthest_[k]) / sides;
        }
        return beyond > min_reach * object.width();
    }

private:
    std::array<glm::dvec3, sides> directions_{};
    std::array<double, sides> farthest_{};
};

} // namespace

Scraps find_table(const SourceMesh& mesh, const Scraps& ignored) {
    const Facets facets(mesh, ignored);
    if (facets.count() < min_triangles) {
        return {};
    }
    const std::vector<Facet> some = sampled(facets);
    Extents all;
    for (const Facet& facet : some) {
        all.add(facet);
    }
    const double tolerance = flatness * all.longest();
    std::optional<Plane> plane = widest_plane(some, tolerance);
    plane = plane ? towards_rest(*plane, some, 3.0 * tolerance) : std::nullopt;
    if (!plane) {
        return {};
    }
    Reach table(*plane);
    Reach object(*plane);
    Extents left;
    double height = 0.0;
    Scraps found{.is_scrap = std::vector<bool>(facets.count(), false)};
    for (std::size_t t = 0; t < facets.count(); ++t) {
        if (!facets.counts(t)) {
            continue;
        }
        const Facet facet = facets.at(t);
        const bool is_below =
            std::all_of(facet.corners.begin(), facet.corners.end(),
                        [&](const glm::dvec3& corner) { return plane->distance(corner) < tolerance; });
        if (is_below) {
            found.is_scrap[t] = true;
            ++found.triangles;
            table.add(facet);
        } else {
            left.add(facet);
            if (plane->distance(facet.middle()) > 3.0 * tolerance) {
                object.add(facet);
                height = std::max(height, plane->distance(facet.middle()));
            }
        }
    }
    if (height < min_height * object.width() || !table.is_around(object)) {
        return {};
    }
    found.size_with = all.longest();
    found.size_without = left.longest();
    return found;
}

} // namespace frustumscreen::bake
