#include "app/scene/beyond_prop.h"

#include "app/scene/cell_plan.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

namespace frustumscreen::scene {

namespace {

std::array<glm::dvec3, 8> corners_in_prop(const PlacedLevel& level) {
    const geometry::Box box = level.placed_box();
    std::array<glm::dvec3, 8> corners{};
    for (unsigned k = 0; k < corners.size(); ++k) {
        const glm::dvec3 corner((k & 1U) != 0 ? box.high.x : box.low.x,
                                (k & 2U) != 0 ? box.high.y : box.low.y,
                                (k & 4U) != 0 ? box.high.z : box.low.z);
        corners[k] = glm::dvec3(level.prop_from_placed * glm::dvec4(corner, 1.0));
    }
    return corners;
}

bool all_outside(std::span<const glm::dvec3> corners, const glm::dvec3& normal, double offset) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](const glm::dvec3& corner) { return glm::dot(normal, corner) < offset; });
}

/// Behind the face, within the pyramid of the eye and the face's edges.
bool shows_through(const geometry::PropFace& face, const glm::dvec3& eye,
                   std::span<const glm::dvec3> corners) {
    if (!(face.plane.distance(eye) > 0.0) || all_outside(corners, -face.plane.normal, -face.plane.offset)) {
        return false;
    }
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
        const glm::dvec3 inward = glm::cross(face.corners[face.corners.next(k)] - eye, face.corners[k] - eye);
        if (all_outside(corners, inward, glm::dot(inward, eye))) {
            return false;
        }
    }
    return true;
}

} // namespace

geometry::Box box_around(const geometry::PropShape& prop) {
    geometry::Box box{glm::dvec3(std::numeric_limits<double>::infinity()),
                      glm::dvec3(-std::numeric_limits<double>::infinity())};
    for (const geometry::PropFace& face : prop.faces) {
        for (const glm::dvec3& corner : face.corners) {
            box = {glm::min(box.low, corner), glm::max(box.high, corner)};
        }
    }
    return box;
}

glm::dvec4 half_space_behind(const geometry::PropFace& face, const glm::dmat4& prop_from_frame) {
    return glm::dvec4(-face.plane.normal, face.plane.offset) * prop_from_frame;
}

glm::dvec3 nearest_in_box(const PlacedLevel& level, const glm::dmat4& placed_from_prop,
                          const glm::dvec3& in_prop) {
    const geometry::Box box = level.placed_box();
    const glm::dvec3 placed(placed_from_prop * glm::dvec4(in_prop, 1.0));
    return glm::clamp(placed, box.low, box.high) / level.metres_per_box;
}

double pixels_beyond(const PlacedLevel& level, const geometry::PropShape& prop, const PlanView& view) {
    const std::array<glm::dvec3, 8> corners = corners_in_prop(level);
    const geometry::RigidTransform prop_from_table = view.table_from_prop.inverse();
    const bool shows = std::any_of(view.eyes_m.begin(), view.eyes_m.end(), [&](const glm::dvec3& eye_m) {
        const glm::dvec3 eye = prop_from_table.point(eye_m);
        return std::any_of(prop.faces.begin(), prop.faces.end(),
                           [&](const geometry::PropFace& face) { return shows_through(face, eye, corners); });
    });
    if (!shows) {
        return 0.0;
    }
    const geometry::Box box = box_around(prop);
    PlacedLevel whole;
    whole.box_size = box.high - box.low;
    return std::min(pixels_of(level, view), pixels_of(whole, view));
}

} // namespace frustumscreen::scene
