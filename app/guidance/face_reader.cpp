#include "app/guidance/face_reader.h"

#include "app/guidance/seen_places.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace frustumscreen::guidance {

namespace {

/// A point closer to the eye than this, or behind it, is moved to this distance, as a fraction of that to the prop's
/// middle.
constexpr double nearest_share = 0.01;

/// The direction from the eye to the prop's middle.
glm::dvec3 forward_from(const glm::dvec3& eye, const geometry::PropShape& prop) {
    const glm::dvec3 way = prop.middle - eye;
    return way / std::fmax(glm::length(way), 1e-9);
}

/// The sine at a corner is the height over the plane divided by the corner's distance.
bool sees(const glm::dvec3& point, const geometry::PropFace& face, double min_sine) {
    const double height = face.plane.distance(point);
    if (!(height > 0.0)) {
        return false;
    }
    double farthest = 0.0;
    for (const glm::dvec3& corner : face.corners) {
        const glm::dvec3 way = corner - point;
        farthest = std::fmax(farthest, glm::dot(way, way));
    }
    return height * height >= min_sine * min_sine * farthest;
}

/// The eye and the projector in the prop's frame.
struct Views {
    glm::dvec3 eye;
    glm::dvec3 lens;
    geometry::RigidTransform projector_from_prop;

    Views(const GuidanceSetup& setup, const geometry::RigidTransform& projector_from_table,
          const GuidedState& tracked_state)
        : projector_from_prop(projector_from_table * tracked_state.table_from_prop) {
        const geometry::RigidTransform prop_from_table = tracked_state.table_from_prop.inverse();
        eye = prop_from_table.point(tracked_state.eye_m);
        lens = prop_from_table.point(setup.table_from_projector.translation);
    }
    [[nodiscard]] bool seen(const geometry::PropFace& face) const {
        return sees(eye, face, FaceReader::min_sine_of_sight);
    }
    [[nodiscard]] bool turned_to_light(const geometry::PropFace& face, const GuidanceSetup& setup) const {
        return sees(lens, face, setup.min_sine_of_light);
    }
    [[nodiscard]] bool lit(const geometry::PropFace& face, const GuidanceSetup& setup) const {
        const geometry::Pinhole& pinhole = setup.projector;
        return turned_to_light(face, setup) &&
               std::all_of(face.corners.begin(), face.corners.end(), [&](const glm::dvec3& corner) {
                   const auto pixel = pinhole.pixel(projector_from_prop.point(corner));
                   return pixel && pixel->x >= 0.0 && pixel->y >= 0.0 && pixel->x <= pinhole.width &&
                          pixel->y <= pinhole.height;
               });
    }
    /// Calls `visit` with disjoint parts that together are the face's unlit area, until it returns false.
    template <typename Visit>
    bool for_each_unlit(const geometry::PropFace& face, const GuidanceSetup& setup,
                        const std::array<geometry::Plane, 4>& picture, const Visit& visit) const {
        FacePart rest(face.corners);
        if (!turned_to_light(face, setup)) {
            return visit(rest);
        }
        for (const geometry::Plane& edge : picture) {
            const geometry::Plane inward = in_prop(edge);
            const FacePart outside = rest.clipped(-inward.normal, -inward.offset);
            if (!outside.empty() && !visit(outside)) {
                return false;
            }
            rest = rest.clipped(inward.normal, inward.offset);
        }
        return true;
    }

private:
    /// A plane through the lens, from the projector's frame.
    [[nodiscard]] geometry::Plane in_prop(const geometry::Plane& plane) const {
        const glm::dvec3 normal = glm::conjugate(projector_from_prop.rotation) * plane.normal;
        return {normal, glm::dot(normal, lens)};
    }
};

/// The situation for one of the two eyes alone.
GuidedState of_left_eye(const GuidedState& tracked_state) {
    return {tracked_state.table_from_prop, tracked_state.eye_m - tracked_state.to_right_eye_m};
}

GuidedState of_right_eye(const GuidedState& tracked_state) {
    return {tracked_state.table_from_prop, tracked_state.eye_m + tracked_state.to_right_eye_m};
}

} // namespace

FaceReader::FaceReader(GuidanceSetup setup)
    : setup_(std::move(setup)), projector_from_table_(setup_.table_from_projector.inverse()),
      picture_(geometry::picture_planes(setup_.projector, geometry::RigidTransform())) {
    assert(setup_.prop.faces.size() <= 32);
}

FaceSets FaceReader::read(const GuidedState& tracked_state) const {
    if (tracked_state.has_two_eyes()) {
        const FaceSets left = read(of_left_eye(tracked_state));
        return {left.seen | read(of_right_eye(tracked_state)).seen, left.lit};
    }
    const Views views(setup_, projector_from_table_, tracked_state);
    FaceSets sets;
    for (std::size_t k = 0; k < setup_.prop.faces.size(); ++k) {
        const geometry::PropFace& face = setup_.prop.faces[k];
        sets.seen |= views.seen(face) ? std::uint32_t{1} << k : 0U;
        sets.lit |= views.lit(face, setup_) ? std::uint32_t{1} << k : 0U;
    }
    return sets;
}

bool FaceReader::valid(const GuidedState& tracked_state) const {
    if (tracked_state.has_two_eyes()) {
        return valid(of_left_eye(tracked_state)) && valid(of_right_eye(tracked_state));
    }
    const Views views(setup_, projector_from_table_, tracked_state);
    return std::all_of(
        setup_.prop.faces.begin(), setup_.prop.faces.end(),
        [&](const geometry::PropFace& face) { return !views.seen(face) || views.lit(face, setup_); });
}

bool FaceReader::whole(const GuidedState& tracked_state) const {
    if (tracked_state.has_two_eyes()) {
        return whole(of_left_eye(tracked_state)) && whole(of_right_eye(tracked_state));
    }
    const std::span<const glm::dvec3> hull = shown();
    if (hull.empty()) {
        return valid(tracked_state);
    }
    const Views views(setup_, projector_from_table_, tracked_state);
    return std::all_of(setup_.prop.faces.begin(), setup_.prop.faces.end(),
                       [&](const geometry::PropFace& face) {
                           return !views.seen(face) || views.lit(face, setup_) ||
                                  views.for_each_unlit(face, setup_, picture_, [&](const FacePart& unlit) {
                                      return !sees_through(views.eye, unlit, hull);
                                  });
                       });
}

double FaceReader::unlit_px(const GuidedState& tracked_state) const {
    if (tracked_state.has_two_eyes()) {
        return 0.5 * (unlit_px(of_left_eye(tracked_state)) + unlit_px(of_right_eye(tracked_state)));
    }
    return area_px(tracked_state, read(tracked_state).unlit());
}

double FaceReader::lost_px(const GuidedState& tracked_state) const {
    if (tracked_state.has_two_eyes()) {
        return 0.5 * (lost_px(of_left_eye(tracked_state)) + lost_px(of_right_eye(tracked_state)));
    }
    const std::span<const glm::dvec3> hull = shown();
    if (hull.empty()) {
        return unlit_px(tracked_state);
    }
    const Views views(setup_, projector_from_table_, tracked_state);
    const SeenOutline outline(views.eye, forward_from(views.eye, setup_.prop), hull);
    double area = 0.0;
    for (const geometry::PropFace& face : setup_.prop.faces) {
        if (!views.seen(face) || views.lit(face, setup_)) {
            continue;
        }
        views.for_each_unlit(face, setup_, picture_, [&](const FacePart& unlit) {
            area += outline.area_through(unlit);
            return true;
        });
    }
    return area * pixels_per_radian * pixels_per_radian;
}

double FaceReader::area_px(const GuidedState& tracked_state, std::uint32_t faces) const {
    if (faces == 0) {
        return 0.0;
    }
    const geometry::PropShape& prop = setup_.prop;
    const glm::dvec3 eye = tracked_state.table_from_prop.inverse().point(tracked_state.eye_m);
    const glm::dvec3 way = prop.middle - eye;
    const double distance = std::fmax(glm::length(way), 1e-9);
    const glm::dvec3 forward = way / distance;
    const glm::dvec3 helper = std::abs(forward.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, helper));
    const glm::dvec3 up = glm::cross(right, forward);
    double area = 0.0;
    for (std::size_t k = 0; k < prop.faces.size(); ++k) {
        if ((faces >> k & 1U) == 0) {
            continue;
        }
        geometry::PerCorner<glm::dvec2> seen;
        for (const glm::dvec3& corner : prop.faces[k].corners) {
            const glm::dvec3 to = corner - eye;
            const double depth = std::fmax(glm::dot(to, forward), nearest_share * distance);
            seen.push_back(glm::dvec2(glm::dot(to, right), glm::dot(to, up)) / depth);
        }
        double twice = 0.0;
        for (std::size_t c = 0; c < seen.size(); ++c) {
            const glm::dvec2& a = seen[c];
            const glm::dvec2& b = seen[seen.next(c)];
            twice += a.x * b.y - b.x * a.y;
        }
        area += 0.5 * std::abs(twice);
    }
    return area * pixels_per_radian * pixels_per_radian;
}

std::uint32_t FaceReader::largest_of(const GuidedState& tracked_state, std::uint32_t faces) const {
    std::uint32_t largest = 0;
    double most = 0.0;
    for (std::uint32_t rest = faces; rest != 0; rest &= rest - 1) {
        const std::uint32_t face = rest & (~rest + 1);
        const double area = area_px(tracked_state, face);
        if (area > most) {
            most = area;
            largest = face;
        }
    }
    return largest;
}

} // namespace frustumscreen::guidance
