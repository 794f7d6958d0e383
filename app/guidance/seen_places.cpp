#include "app/guidance/seen_places.h"

#include "app/geometry/planar_hull.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::guidance {

namespace {

/// An overlap of cones smaller than this angle is rounding and does not count.
constexpr double touching_rad = 1e-9;

/// True if all of `directions` lie in the plane or on the side to which `normal` points.
template <typename Directions>
bool lies_before(const glm::dvec3& normal, const Directions& directions, const glm::dvec3& eye) {
    return std::all_of(directions.begin(), directions.end(), [&](const glm::dvec3& point) {
        const glm::dvec3 way = point - eye;
        const double height = glm::dot(normal, way);
        return height >= 0.0 || height * height <= touching_rad * touching_rad * glm::dot(way, way);
    });
}

/// The plane through the eye and `corner` that touches the hull and has all of it behind: its unit normal, or zero if
/// the hull lies on both sides. `side`: 1 or -1, the side of the corner on which it touches.
glm::dvec3 touching_plane(const glm::dvec3& eye, const glm::dvec3& corner, std::span<const glm::dvec3> hull,
                          double side) {
    const glm::dvec3 way = corner - eye;
    glm::dvec3 normal(0.0);
    for (const glm::dvec3& point : hull) {
        const glm::dvec3 to = point - eye;
        if (normal == glm::dvec3(0.0) || glm::dot(normal, to) > 0.0) {
            normal = side * glm::cross(way, to);
        }
    }
    const double length = glm::length(normal);
    return length > 0.0 ? normal / length : glm::dvec3(0.0);
}

enum class Meeting { Meet, Apart, Unclear };

/// Decides the usual cases: a corner of the hull is seen through the part, or one of the part's edges has all of the
/// hull behind it.
Meeting meeting_at_edges(const glm::dvec3& eye, const FacePart& part, std::span<const glm::dvec3> hull) {
    const std::span<const glm::dvec3> corners = part.corners();
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& corner : corners) {
        middle += corner - eye;
    }
    std::array<glm::dvec3, FacePart::max_corners> inward{};
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const glm::dvec3 normal = glm::cross(corners[k] - eye, corners[(k + 1) % corners.size()] - eye);
        inward.at(k) = glm::dot(normal, middle) < 0.0 ? -normal : normal;
    }
    unsigned apart = (1U << corners.size()) - 1U; // edges that have all of the hull behind them so far
    for (const glm::dvec3& point : hull) {
        const glm::dvec3 way = point - eye;
        unsigned behind = 0;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            behind |= glm::dot(inward[k], way) <= 0.0 ? 1U << k : 0U;
        }
        if (behind == 0) {
            return Meeting::Meet;
        }
        apart &= behind;
    }
    return apart != 0 ? Meeting::Apart : Meeting::Unclear;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

double area_of(std::span<const glm::dvec2> polygon) {
    double area = 0.0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        area += 0.5 * cross(polygon[k], polygon[(k + 1) % polygon.size()]);
    }
    return std::abs(area);
}

/// The picture plane of a pinhole at distance 1.
struct View {
    View(const glm::dvec3& at, const glm::dvec3& along) : eye(at), forward(along) {
        const glm::dvec3 helper = std::abs(along.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
        right = glm::normalize(glm::cross(along, helper));
        up = glm::cross(right, along);
    }
    /// A point beside or behind the eye is moved to a little in front of it.
    [[nodiscard]] glm::dvec2 seen(const glm::dvec3& point) const {
        constexpr double nearest_m = 1e-3;
        const glm::dvec3 way = point - eye;
        return glm::dvec2(glm::dot(way, right), glm::dot(way, up)) /
               std::fmax(glm::dot(way, forward), nearest_m);
    }
    /// The direction from the eye to a point of the picture.
    [[nodiscard]] glm::dvec3 ray(const glm::dvec2& at) const { return forward + at.x * right + at.y * up; }
    glm::dvec3 eye;
    glm::dvec3 forward;
    glm::dvec3 right{0.0};
    glm::dvec3 up{0.0};
};

} // namespace

FacePart FacePart::clipped(const glm::dvec3& inward, double offset) const {
    FacePart part;
    for (std::size_t k = 0; k < count_; ++k) {
        const glm::dvec3& a = corners_.at(k);
        const glm::dvec3& b = corners_.at((k + 1) % count_);
        const double a_inside = glm::dot(inward, a) - offset;
        const double b_inside = glm::dot(inward, b) - offset;
        if (a_inside >= 0.0) {
            part.add(a);
        }
        if ((a_inside > 0.0 && b_inside < 0.0) || (a_inside < 0.0 && b_inside > 0.0)) {
            part.add(a + (b - a) * (a_inside / (a_inside - b_inside)));
        }
    }
    return part;
}

bool sees_through(const glm::dvec3& eye, const FacePart& part, std::span<const glm::dvec3> hull) {
    if (part.empty() || hull.empty()) {
        return false;
    }
    if (const Meeting meeting = meeting_at_edges(eye, part, hull); meeting != Meeting::Unclear) {
        return meeting == Meeting::Meet;
    }
    for (const glm::dvec3& corner : part.corners()) {
        for (const double side : {1.0, -1.0}) {
            const glm::dvec3 normal = touching_plane(eye, corner, hull, side);
            if (normal != glm::dvec3(0.0) && lies_before(normal, part.corners(), eye) &&
                lies_before(-normal, hull, eye)) {
                return false;
            }
        }
    }
    return true;
}

SeenOutline::SeenOutline(const glm::dvec3& eye, const glm::dvec3& forward, std::span<const glm::dvec3> hull)
    : eye_(eye), forward_(forward) {
    if (hull.size() < 3 || hull.size() > max_corners) {
        return;
    }
    const View view(eye, forward);
    std::array<glm::dvec2, max_corners>
        points; // NOLINT(cppcoreguidelines-pro-type-member-init): as many as are used
    std::transform(hull.begin(), hull.end(), points.begin(),
                   [&](const glm::dvec3& point) { return view.seen(point); });
    count_ = geometry::planar_hull(std::span(points).first(hull.size()), outline_).size();
}

template <typename Use> void SeenOutline::clip_to(const FacePart& part, const Use& use) const {
    if (part.empty() || count_ < 3) {
        return;
    }
    const View view(eye_, forward_);
    const std::size_t sides = part.corners().size();
    std::array<glm::dvec2, FacePart::max_corners> window{};
    std::transform(part.corners().begin(), part.corners().end(), window.begin(),
                   [&](const glm::dvec3& point) { return view.seen(point); });
    double twice = 0.0;
    for (std::size_t k = 0; k < sides; ++k) {
        twice += cross(window.at(k), window.at((k + 1) % sides));
    }
    const double turn = twice < 0.0 ? -1.0 : 1.0;
    // Both are convex: the part's few edges clip the outline, alternating between two arrays.
    std::array<std::array<glm::dvec2, 2 * max_corners>, 2>
        chains; // NOLINT(cppcoreguidelines-pro-type-member-init)
    std::copy_n(outline_.begin(), count_, chains[0].begin());
    std::size_t count = count_;
    for (std::size_t side = 0; side < sides && count > 0; ++side) {
        const auto& from_chain = chains.at(side % 2);
        auto& to_chain = chains.at((side + 1) % 2);
        const glm::dvec2& from = window.at(side);
        const glm::dvec2 along = turn * (window.at((side + 1) % sides) - from);
        std::size_t kept = 0;
        for (std::size_t k = 0; k < count; ++k) {
            const glm::dvec2& a = from_chain.at(k);
            const glm::dvec2& b = from_chain.at((k + 1) % count);
            const double a_inside = cross(along, a - from);
            const double b_inside = cross(along, b - from);
            if (a_inside >= 0.0) {
                to_chain.at(kept++) = a;
            }
            if ((a_inside > 0.0 && b_inside < 0.0) || (a_inside < 0.0 && b_inside > 0.0)) {
                to_chain.at(kept++) = a + (b - a) * (a_inside / (a_inside - b_inside));
            }
        }
        count = kept;
    }
    use(view, std::span<const glm::dvec2>(chains.at(sides % 2)).first(count));
}

double SeenOutline::area_through(const FacePart& part) const {
    double area = 0.0;
    clip_to(part, [&](const View&, std::span<const glm::dvec2> seen) { area = area_of(seen); });
    return area;
}

SeenOutline::Through SeenOutline::through(const geometry::PropFace& face, const glm::dvec3& point) const {
    Through result;
    clip_to(FacePart(face.corners), [&](const View& view, std::span<const glm::dvec2> seen) {
        const double all = area_of(std::span(outline_).first(count_));
        result.share = all > 0.0 ? area_of(seen) / all : 0.0;
        for (const glm::dvec2& at : seen) {
            const glm::dvec3 ray = view.ray(at);
            const double towards = -glm::dot(face.plane.normal, ray);
            if (towards > 0.0) {
                const glm::dvec3 place = view.eye + face.plane.distance(view.eye) / towards * ray;
                result.farthest_m = std::fmax(result.farthest_m, glm::distance(place, point));
            }
        }
    });
    return result;
}

} // namespace frustumscreen::guidance
