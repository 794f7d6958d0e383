#include "app/exhibit/leader_line.h"

#include "app/typography/visitor_side.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::exhibit {

namespace {

constexpr double from_prop_m = 0.004;    ///< between the prop's outline and the line
constexpr double from_picture_m = 0.004; ///< between a picture and the line
constexpr double shortest_m = 0.003;     ///< a shorter line is a dot

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// The share of the way from `a` to `b` at which it leaves the convex polygon, grown by `margin_m`, for the last
/// time; 0 if it never meets it, more than 1 if it ends inside.
double leaves_at(const typography::TablePolygon& polygon, const glm::dvec2& a, const glm::dvec2& b,
                 double margin_m) {
    double first = 0.0;
    double last = std::numeric_limits<double>::infinity();
    const std::span<const glm::dvec2> corners = polygon.corners();
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const glm::dvec2 edge = corners[(k + 1) % corners.size()] - corners[k];
        const double length = glm::length(edge);
        if (!(length > 0.0)) {
            continue;
        }
        // Inside where both shares are above -margin.
        const double at_a = cross(edge, a - corners[k]) / length + margin_m;
        const double rate = cross(edge, b - a) / length;
        if (rate > 0.0) {
            first = std::max(first, -at_a / rate);
        } else if (rate < 0.0) {
            last = std::min(last, -at_a / rate);
        } else if (at_a < 0.0) {
            return 0.0;
        }
    }
    return !corners.empty() && first < std::min(last, 1.0) ? last : 0.0;
}

/// A point in the rectangle's frame: origin at its middle, axes along its sides.
glm::dvec2 seen_from(const typography::TableRectangle& rectangle, const glm::dvec2& point) {
    return typography::turned(point - rectangle.centre_m, -rectangle.quarter_turns);
}

glm::dvec2 nearest_of(const typography::TableRectangle& rectangle, const glm::dvec2& point) {
    const glm::dvec2 half = 0.5 * rectangle.size_m;
    const glm::dvec2 nearest = glm::clamp(seen_from(rectangle, point), -half, half);
    return rectangle.centre_m + typography::turned(nearest, rectangle.quarter_turns);
}

/// True if a segment comes closer than `from_picture_m` to a picture.
bool crosses(const typography::TableRectangle& picture, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 half = 0.5 * picture.size_m + from_picture_m;
    const glm::dvec2 from = seen_from(picture, a);
    const glm::dvec2 way = seen_from(picture, b) - from;
    double first = 0.0;
    double last = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
        if (way[axis] == 0.0) {
            if (std::abs(from[axis]) >= half[axis]) {
                return false;
            }
            continue;
        }
        const double s = (-half[axis] - from[axis]) / way[axis];
        const double t = (half[axis] - from[axis]) / way[axis];
        first = std::max(first, std::min(s, t));
        last = std::min(last, std::max(s, t));
    }
    return first < last;
}

class Way {
public:
    explicit Way(const LeaderLineNeeds& needs) : needs_(needs) {}

    [[nodiscard]] bool is_free(const glm::dvec2& a, const glm::dvec2& b) const {
        return std::none_of(
            needs_.pictures.begin(), needs_.pictures.end(),
            [&](const typography::TableRectangle& picture) { return crosses(picture, a, b); });
    }
    [[nodiscard]] bool is_beside_prop(const glm::dvec2& a, const glm::dvec2& b) const {
        return last_exit(a, b) <= 0.0;
    }
    /// The share of the way from `a` to `b` from which the line is clear of the prop and its shadow.
    [[nodiscard]] double last_exit(const glm::dvec2& a, const glm::dvec2& b) const {
        return std::max(leaves_at(*needs_.shadow, a, b, from_prop_m),
                        leaves_at(*needs_.hidden, a, b, from_prop_m));
    }

private:
    const LeaderLineNeeds& needs_;
};

/// The shortest line that goes around one corner of a picture.
std::optional<LeaderLine> with_bend(const LeaderLineNeeds& needs, const Way& way, const glm::dvec2& seen) {
    std::optional<LeaderLine> best;
    double best_length = std::numeric_limits<double>::infinity();
    for (const typography::TableRectangle& picture : needs.pictures) {
        typography::TableRectangle around = picture;
        around.size_m += 2.0 * (from_picture_m + 1e-6);
        for (const glm::dvec2& bend : around.corners()) {
            const glm::dvec2 end = nearest_of(needs.label, bend);
            const double exit = way.last_exit(seen, bend);
            const glm::dvec2 begin = seen + exit * (bend - seen);
            const double length = glm::distance(begin, bend) + glm::distance(bend, end);
            if (exit < 1.0 && length < best_length && way.is_free(begin, bend) && way.is_free(bend, end) &&
                way.is_beside_prop(bend, end)) {
                best_length = length;
                best = LeaderLine{{begin, bend, end}, 3};
            }
        }
    }
    return best;
}

} // namespace

bool is_seen(const Hotspot& hotspot, const glm::dvec3& eye_m, const geometry::PropShape& prop,
             const LitPlaces& lit, const Occluder& artifact) {
    const glm::dvec3 to_point = hotspot.point_m - eye_m;
    if (!(glm::dot(to_point, hotspot.normal) < 0.0)) {
        return false; // faces away
    }
    geometry::PropHit entry;
    if (!geometry::intersect(prop, eye_m, to_point, entry) || entry.t > 1.0 ||
        (lit.faces >> entry.face & 1U) == 0) {
        return false;
    }
    const glm::dvec3 place = lit.table_from_prop.point(eye_m + entry.t * to_point);
    if (!std::all_of(lit.picture_edges.begin(), lit.picture_edges.end(),
                     [&](const geometry::Plane& edge) { return edge.distance(place) >= 0.0; })) {
        return false;
    }
    const glm::dvec3 end = hotspot.point_m + artifact.tolerance_m * hotspot.normal;
    const auto mapped = [&](const glm::dvec3& point) {
        return glm::dvec3(artifact.triangles_from_prop * glm::dvec4(point, 1.0));
    };
    return artifact.triangles == nullptr || !artifact.triangles->meets(mapped(eye_m), mapped(end));
}

std::optional<LeaderLine> leader_line(const LeaderLineNeeds& needs) {
    if (!needs.shadow || !needs.hidden || !(needs.point_m.z < 0.99 * needs.eye_m.z)) {
        return std::nullopt;
    }
    const double share = needs.eye_m.z / (needs.eye_m.z - std::max(0.0, needs.point_m.z));
    const glm::dvec2 seen = glm::dvec2(needs.eye_m) + share * glm::dvec2(needs.point_m - needs.eye_m);
    const Way way(needs);
    const glm::dvec2 end = nearest_of(needs.label, seen);
    const double exit = way.last_exit(seen, end);
    if (!(exit < 1.0)) {
        return std::nullopt;
    }
    const glm::dvec2 begin = seen + exit * (end - seen);
    if (way.is_free(begin, end)) {
        return glm::distance(begin, end) >= shortest_m ? std::optional(LeaderLine{{begin, end}, 2})
                                                       : std::nullopt;
    }
    return with_bend(needs, way, seen);
}

} // namespace frustumscreen::exhibit
