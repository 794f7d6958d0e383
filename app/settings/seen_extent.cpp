// The points of a prop through which eyes all around see an artifact.
//
// An eye E before a face sees the corner h of the hull, d behind the face's plane, through the point
//     S = (d E + e h) / (d + e),     e: distance of E before the plane.
// Let S1 and S2 be two of these points, from E1, h1 and E2, h2. A point between them, m S1 + (1 - m) S2, is a
// weighted mean of the four: the eyes' part lies on the line from E1 to E2, the hull's part on the line from h1 to
// h2, and the point on the line between these two parts. So a convex set of eyes sees a convex hull through a
// convex set of points: the convex hull of the points of all pairs of corners. Directions are corners at infinity,
// E = (x, 0) in homogeneous coordinates.
#include "app/settings/whole_zone.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustumscreen::settings {

namespace {

constexpr int wedges = 72;
constexpr double far_away_m = 1e6; ///< a finite stand-in for infinity on a face

/// A corner of the eyes' zone: a point if w is 1, a direction if w is 0.
struct EyeCorner {
    glm::dvec3 x{0.0};
    double w = 1.0;
};

/// The corners of a convex solid that contains all eyes between two azimuths.
std::vector<EyeCorner> wedge_of(const EyesAround& eyes, int wedge) {
    constexpr double width = 2.0 * std::numbers::pi / wedges;
    const double outward = 1.0 / std::cos(0.5 * width); // the chord is tangent to the arc
    std::vector<EyeCorner> corners;
    for (const int side : {0, 1}) {
        const double azimuth = width * (wedge + side);
        const glm::dvec3 ahead(outward * std::cos(azimuth), outward * std::sin(azimuth), 0.0);
        const glm::dvec3 at = ahead * std::cos(eyes.lowest_rad) + glm::dvec3(0, 0, std::sin(eyes.lowest_rad));
        corners.push_back({eyes.nearest_m * at, 1.0});
        if (eyes.higher_and_farther) {
            corners.push_back({at, 0.0});
        }
    }
    if (eyes.higher_and_farther) {
        corners.push_back({glm::dvec3(0.0, 0.0, eyes.nearest_m), 1.0});
        corners.push_back({glm::dvec3(0.0, 0.0, 1.0), 0.0});
    }
    return corners;
}

/// The part of the solid before the plane; `before` gets each corner's distance.
std::vector<EyeCorner> in_front(const std::vector<EyeCorner>& corners, const geometry::Plane& plane,
                                std::vector<double>& before) {
    const auto distance = [&](const EyeCorner& c) {
        return glm::dot(plane.normal, c.x) - c.w * plane.offset;
    };
    std::vector<EyeCorner> front;
    before.clear();
    for (const EyeCorner& a : corners) {
        if (distance(a) > 0.0) {
            front.push_back(a);
            before.push_back(distance(a));
        }
    }
    const std::size_t whole = front.size();
    for (std::size_t k = 0; k < whole; ++k) {
        for (const EyeCorner& b : corners) {
            if (const double behind = distance(b); behind <= 0.0) {
                const double share = before[k] / (before[k] - behind);
                front.push_back({glm::mix(front[k].x, b.x, share), glm::mix(front[k].w, b.w, share)});
                before.push_back(0.0);
            }
        }
    }
    return front;
}

/// A face with coordinate axes in its plane.
struct FaceAxes {
    explicit FaceAxes(const geometry::PropFace& of)
        : face(of), u(glm::normalize(of.corners[1] - of.corners[0])), v(glm::cross(of.plane.normal, u)),
          middle(of.middle()) {}

    [[nodiscard]] glm::dvec2 flat(const glm::dvec3& point) const {
        return {glm::dot(point - middle, u), glm::dot(point - middle, v)};
    }
    [[nodiscard]] glm::dvec3 solid(const glm::dvec2& at) const { return middle + at.x * u + at.y * v; }
    /// The part of a polygon that lies on the face.
    [[nodiscard]] Polygon on_face(Polygon polygon) const {
        for (std::size_t k = 0; k < face.corners.size() && !polygon.empty(); ++k) {
            const glm::dvec2 a = flat(face.corners[k]);
            const glm::dvec2 along = flat(face.corners[(k + 1) % face.corners.size()]) - a;
            const glm::dvec2 inward = glm::normalize(glm::dvec2(-along.y, along.x));
            polygon = clipped(polygon, {inward, glm::dot(inward, a)});
        }
        return polygon;
    }

    const geometry::PropFace& face;
    glm::dvec3 u, v, middle;
};

/// The points of the face's plane through which these eyes see the hull.
Polygon seen_on_plane(const FaceAxes& axes, const std::vector<EyeCorner>& eyes,
                      const std::vector<double>& before, std::span<const glm::dvec3> hull) {
    std::vector<glm::dvec2> places;
    for (const glm::dvec3& corner : hull) {
        const double behind = -axes.face.plane.distance(corner);
        for (std::size_t k = 0; k < eyes.size(); ++k) {
            const glm::dvec3 x = behind * eyes[k].x + before[k] * corner;
            const double w = behind * eyes[k].w + before[k];
            const glm::dvec3 from_middle = x - w * axes.middle;
            const glm::dvec2 flat(glm::dot(from_middle, axes.u), glm::dot(from_middle, axes.v));
            const double length = glm::length(flat);
            if (w * far_away_m > length) {
                places.push_back(flat / w);
            } else if (length > 0.0) {
                places.push_back(flat * (far_away_m / length));
            }
        }
    }
    return places.size() < 3 ? Polygon() : convex_polygon(std::move(places));
}

} // namespace

EyesAround all_eyes(const EyeSettings& eye) {
    return {glm::radians(eye.lowest_elevation_deg), eye.nearest_m, true};
}

EyesAround eyes_like_default(const EyeSettings& eye) {
    const glm::dvec3& at = eye.default_m;
    return {std::atan2(at.z, glm::length(glm::dvec2(at))), glm::length(at), false};
}

Polygon seen_extent(const geometry::PropShape& prop, const EyesAround& eyes,
                    std::span<const glm::dvec3> hull) {
    std::vector<glm::dvec2> rounds;
    const auto add = [&](const glm::dvec3& place) {
        rounds.emplace_back(glm::length(glm::dvec2(place)), place.z);
    };
    std::vector<double> before;
    for (const geometry::PropFace& face : prop.faces) {
        const FaceAxes axes(face);
        // An artifact that extends beyond the prop may be seen through all of the face.
        constexpr double rounding_m = 1e-9;
        if (std::any_of(hull.begin(), hull.end(),
                        [&](const glm::dvec3& corner) { return face.plane.distance(corner) > rounding_m; })) {
            std::for_each(face.corners.begin(), face.corners.end(), add);
            continue;
        }
        for (int wedge = 0; wedge < wedges; ++wedge) {
            const std::vector<EyeCorner> front = in_front(wedge_of(eyes, wedge), face.plane, before);
            for (const glm::dvec2& place : axes.on_face(seen_on_plane(axes, front, before, hull))) {
                add(axes.solid(place));
            }
        }
    }
    return rounds.empty() ? Polygon() : convex_polygon(std::move(rounds));
}

} // namespace frustumscreen::settings
