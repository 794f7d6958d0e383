#include "app/geometry/prop_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace frustumscreen::geometry {

namespace {

/// Corners closer than this are at one place: a prop file's numbers are rounded.
constexpr double same_place_m = 1e-6;
/// Corners no higher than this above the lowest one touch the table.
constexpr double touching_m = 0.0005;

PropFace face_of(std::string name, const PerCorner<glm::dvec3>& corners) {
    const glm::dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    return {std::move(name), {normal, glm::dot(normal, corners[0])}, corners};
}

/// All faces except the bottom.
PropShape make_faces(const FrustumSize& size) {
    const double b = size.base_m / 2.0;
    const double t = size.top_m / 2.0;
    const double h = size.height_m;
    const auto bottom = [b](double x, double y) { return glm::dvec3(x * b, y * b, 0.0); };
    const auto top = [t, h](double x, double y) { return glm::dvec3(x * t, y * t, h); };
    PropShape prop;
    prop.faces = {face_of("+X", {bottom(1, -1), bottom(1, 1), top(1, 1), top(1, -1)}),
                  face_of("-X", {bottom(-1, 1), bottom(-1, -1), top(-1, -1), top(-1, 1)}),
                  face_of("+Y", {bottom(1, 1), bottom(-1, 1), top(-1, 1), top(1, 1)}),
                  face_of("-Y", {bottom(-1, -1), bottom(1, -1), top(1, -1), top(-1, -1)}),
                  face_of("+Z", {top(-1, -1), top(1, -1), top(1, 1), top(-1, 1)})};
    prop.corners = {bottom(-1, -1), bottom(1, -1), bottom(1, 1), bottom(-1, 1),
                    top(-1, -1),    top(1, -1),    top(1, 1),    top(-1, 1)};
    prop.middle = {0.0, 0.0, h / 2.0};
    return prop;
}

void bound_by_faces(PropShape& prop) {
    for (const PropFace& face : prop.faces) {
        prop.bounds.push_back(face.plane);
    }
}

bool looks_the_same(const std::vector<glm::dvec3>& corners, int quarters) {
    const auto turned = [quarters](glm::dvec3 corner) {
        for (int k = 0; k < quarters; ++k) {
            corner = {-corner.y, corner.x, corner.z};
        }
        return corner;
    };
    return std::all_of(corners.begin(), corners.end(), [&](const glm::dvec3& corner) {
        return std::any_of(corners.begin(), corners.end(), [&](const glm::dvec3& other) {
            return glm::distance(turned(corner), other) <= same_place_m;
        });
    });
}

} // namespace

glm::dvec3 PropFace::middle() const {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& corner : corners) {
        sum += corner;
    }
    return sum / static_cast<double>(corners.size());
}

std::vector<glm::dvec3> foot_of(const PropShape& prop) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& corner : prop.corners) {
        lowest = std::fmin(lowest, corner.z);
    }
    std::vector<glm::dvec3> foot;
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& corner : prop.corners) {
        if (corner.z <= lowest + touching_m) {
            foot.push_back(corner);
            sum += corner;
        }
    }
    const glm::dvec3 middle = sum / static_cast<double>(foot.size());
    const auto azimuth = [&](const glm::dvec3& corner) {
        return std::atan2(corner.y - middle.y, corner.x - middle.x);
    };
    std::sort(foot.begin(), foot.end(),
              [&](const glm::dvec3& a, const glm::dvec3& b) { return azimuth(a) < azimuth(b); });
    return foot;
}

int quarters_to_same(const PropShape& prop) {
    return looks_the_same(prop.corners, 1) ? 1 : looks_the_same(prop.corners, 2) ? 2 : 4;
}

PropShape make_frustum(FrustumSize size) {
    PropShape prop = make_faces(size);
    bound_by_faces(prop);
    prop.bounds.push_back({glm::dvec3(0, 0, -1), 0.0});
    return prop;
}

PropShape make_cube(double edge_m) {
    PropShape prop = make_faces({edge_m, edge_m, edge_m});
    const std::vector<glm::dvec3>& c = prop.corners;
    prop.faces.push_back(face_of("-Z", {c[3], c[2], c[1], c[0]}));
    bound_by_faces(prop);
    return prop;
}

bool enter(const PropShape& prop, const glm::dvec3& origin, const glm::dvec3& direction, PropHit& hit) {
    double first = -std::numeric_limits<double>::infinity();
    double last = std::numeric_limits<double>::infinity();
    int bound = -1;
    for (std::size_t k = 0; k < prop.bounds.size(); ++k) {
        const double away = prop.bounds[k].distance(origin);
        const double rate = glm::dot(prop.bounds[k].normal, direction);
        if (rate == 0.0) {
            if (away > 0.0) {
                return false;
            }
            continue;
        }
        const double t = -away / rate;
        if (rate < 0.0 && t > first) {
            first = t;
            bound = static_cast<int>(k);
        } else if (rate > 0.0) {
            last = std::fmin(last, t);
        }
    }
    if (!(first > 0.0) || !(first < last) || bound < 0) {
        return false;
    }
    hit = {first, bound};
    return true;
}

bool intersect(const PropShape& prop, const glm::dvec3& origin, const glm::dvec3& direction, PropHit& hit) {
    return enter(prop, origin, direction, hit) && static_cast<std::size_t>(hit.face) < prop.faces.size();
}

double largest_scale_inside(const PropShape& prop, std::span<const glm::dvec3> points) {
    double scale = std::numeric_limits<double>::infinity();
    for (const Plane& bound : prop.bounds) {
        for (const glm::dvec3& point : points) {
            const double reach = glm::dot(bound.normal, point);
            if (reach > 0.0) {
                scale = std::fmin(scale, bound.offset / reach);
            }
        }
    }
    return scale;
}

} // namespace frustumscreen::geometry
