#include "app/geometry/prop_shape.h"

#include <cmath>
#include <limits>

namespace frustumscreen {

namespace {

PropFace face_of(const std::array<glm::dvec3, 4>& corners) {
    const glm::dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    return {{normal, glm::dot(normal, corners[0])}, corners};
}

} // namespace

PropShape make_prop(const PropSize& size) {
    const double b = size.base_m / 2.0;
    const double t = (size.kind == PropKind::Cube ? size.base_m : size.top_m) / 2.0;
    const double h = size.height_m;
    PropShape prop{size, {}, {}};
    const auto bottom = [b](double x, double y) { return glm::dvec3(x * b, y * b, 0.0); };
    const auto top = [t, h](double x, double y) { return glm::dvec3(x * t, y * t, h); };
    prop.faces.push_back(face_of({bottom(1, -1), bottom(1, 1), top(1, 1), top(1, -1)}));
    prop.faces.push_back(face_of({bottom(-1, 1), bottom(-1, -1), top(-1, -1), top(-1, 1)}));
    prop.faces.push_back(face_of({bottom(1, 1), bottom(-1, 1), top(-1, 1), top(1, 1)}));
    prop.faces.push_back(face_of({bottom(-1, -1), bottom(1, -1), top(1, -1), top(-1, -1)}));
    prop.faces.push_back(face_of({top(-1, -1), top(1, -1), top(1, 1), top(-1, 1)}));
    for (const PropFace& face : prop.faces) {
        prop.bounds.push_back(face.plane);
    }
    prop.bounds.push_back({glm::dvec3(0, 0, -1), 0.0});
    return prop;
}

std::string_view name_of(PropKind kind) {
    return kind == PropKind::Cube ? "cube" : "frustum";
}

bool intersect(const PropShape& prop, const glm::dvec3& origin, const glm::dvec3& direction, PropHit& hit) {
    double enter = -std::numeric_limits<double>::infinity();
    double leave = std::numeric_limits<double>::infinity();
    int face = -1;
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
        if (rate < 0.0 && t > enter) {
            enter = t;
            face = static_cast<int>(k);
        } else if (rate > 0.0) {
            leave = std::fmin(leave, t);
        }
    }
    if (!(enter > 0.0) || !(enter < leave) || face < 0 || face >= static_cast<int>(prop.faces.size())) {
        return false;
    }
    hit = {enter, face};
    return true;
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

} // namespace frustumscreen
