#include "app/typography/ring.h"

#include "app/geometry/time_curves.h"
#include "app/typography/visitor_side.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace frustumscreen::typography {

namespace {

constexpr double longest_mitre = 4.0; ///< in widths: a sharper corner is cut
constexpr double comes_up_by = 0.1;   ///< share of the ring

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Outward normal of an edge that is traversed clockwise.
glm::dvec2 normal_of(const glm::dvec2& from, const glm::dvec2& to) {
    const glm::dvec2 along = to - from;
    return glm::dvec2(-along.y, along.x) / glm::length(along);
}

/// A point on the outline, and the direction to the band there.
struct Stop {
    glm::dvec2 at{0.0};
    glm::dvec2 out{0.0}; ///< offset for a distance of one metre from both edges
};

/// The outline, clockwise from the far side; `stops` begins and ends at the same point.
struct Outline {
    std::array<Stop, Ring::most + 1> stops{};
    std::size_t count = 0;
    void add(const Stop& stop) { stops[count++] = stop; }
};

Stop corner(const glm::dvec2& before, const glm::dvec2& at, const glm::dvec2& after) {
    const glm::dvec2 a = normal_of(before, at);
    const glm::dvec2 b = normal_of(at, after);
    const glm::dvec2 out = (a + b) / (1.0 + glm::dot(a, b));
    return {at, out * std::min(1.0, longest_mitre / glm::length(out))};
}

/// The polygon clockwise, without points that are too close to the previous one.
TablePolygon clockwise(const TablePolygon& shadow) {
    constexpr double same_m = 1e-5;
    TablePolygon points;
    for (std::size_t k = shadow.count; k-- > 0;) {
        const glm::dvec2& next = shadow.points[k];
        if (points.count == 0 || (glm::distance(points.points[points.count - 1], next) > same_m &&
                                  glm::distance(points.points[0], next) > same_m)) {
            points.points[points.count++] = next;
        }
    }
    return points;
}

Outline outline_of(const TablePolygon& shadow, int quarter_turns) {
    const TablePolygon points = clockwise(shadow);
    Outline outline;
    if (points.count < 3) {
        return outline;
    }
    const auto point = [&](std::size_t k) { return points.points[k % points.count]; };
    glm::dvec2 middle(0.0);
    for (const glm::dvec2& each : points.corners()) {
        middle += each / static_cast<double>(points.count);
    }
    const glm::dvec2 far = turned({0.0, 1.0}, quarter_turns);
    for (std::size_t k = 0; k < points.count; ++k) {
        const double left = cross(far, point(k) - middle);
        const double right = cross(far, point(k + 1) - middle);
        if (!(left >= 0.0 && right < 0.0)) {
            continue; // the ray from the middle leaves through another edge
        }
        const Stop begin{glm::mix(point(k), point(k + 1), left / (left - right)),
                         normal_of(point(k), point(k + 1))};
        outline.add(begin);
        for (std::size_t j = 1; j <= points.count; ++j) {
            outline.add(corner(point(k + j - 1 + points.count), point(k + j), point(k + j + 1)));
        }
        outline.add(begin);
        break;
    }
    return outline;
}

/// A point inside an edge, not at its ends.
Stop between(const Stop& from, const Stop& to, double share) {
    return {glm::mix(from.at, to.at, share), normal_of(from.at, to.at)};
}

/// The part of an edge inside a convex polygon.
std::optional<std::pair<Stop, Stop>> part_within(const Stop& from, const Stop& to,
                                                 std::span<const glm::dvec2> area) {
    constexpr double shortest_m = 1e-6;
    double first = 0.0;
    double last = 1.0;
    for (std::size_t k = 0; k < area.size(); ++k) {
        const glm::dvec2 side = area[(k + 1) % area.size()] - area[k];
        const double inside = cross(side, from.at - area[k]);
        const double rate = cross(side, to.at - from.at);
        if (rate > 0.0) {
            first = std::max(first, -inside / rate);
        } else if (rate < 0.0) {
            last = std::min(last, -inside / rate);
        } else if (inside < 0.0) {
            return std::nullopt;
        }
    }
    if (!((last - first) * glm::distance(from.at, to.at) > shortest_m)) {
        return std::nullopt;
    }
    return std::pair(first > 0.0 ? between(from, to, first) : from,
                     last < 1.0 ? between(from, to, last) : to);
}

RingPiece piece(const Stop& from, const Stop& to, bool filled) {
    constexpr double outer_m = ring_gap_m + ring_width_m;
    return {{from.at + outer_m * from.out, to.at + outer_m * to.out, to.at + ring_gap_m * to.out,
             from.at + ring_gap_m * from.out},
            filled};
}

} // namespace

Ring ring_around(const TablePolygon& shadow, double full, int quarter_turns,
                 std::span<const glm::dvec2> area) {
    const Outline outline = outline_of(shadow, quarter_turns);
    std::array<std::pair<Stop, Stop>, Ring::most> parts{};
    std::size_t count = 0;
    double length = 0.0;
    for (std::size_t k = 0; k + 1 < outline.count; ++k) {
        if (const auto part = part_within(outline.stops[k], outline.stops[k + 1], area)) {
            length += glm::distance(part->first.at, part->second.at);
            parts[count++] = *part;
        }
    }
    Ring ring;
    double rest = std::clamp(full, 0.0, 1.0) * length;
    for (const auto& [from, to] : std::span(parts).first(count)) {
        const double own = glm::distance(from.at, to.at);
        if (rest > 0.0 && rest < own) {
            const Stop end = between(from, to, rest / own);
            ring.all[ring.count++] = piece(from, end, true);
            ring.all[ring.count++] = piece(end, to, false);
        } else {
            ring.all[ring.count++] = piece(from, to, rest > 0.0);
        }
        rest -= own;
    }
    return ring;
}

double ring_brightness(double full) {
    return geometry::ease(full / comes_up_by);
}

} // namespace frustumscreen::typography
