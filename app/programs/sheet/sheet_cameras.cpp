#include "app/programs/sheet/sheet_cameras.h"

#include "app/geometry/table_plane.h"

#include <algorithm>
#include <limits>

namespace frustumscreen::programs {

namespace {

constexpr double behind_the_visitor = 4.5; ///< times the eye's distance from the prop
constexpr double seen_share = 0.92;        ///< of the picture, filled from the table's legs to the projector

/// Turns and zooms until the points fill at most `share` of the picture and are centred.
void frame(simulation::VisitorCamera& camera, std::span<const glm::dvec3> points, const glm::dvec2& share) {
    const geometry::RigidTransform camera_from_table = camera.table_from_camera.inverse();
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high = -low;
    for (const glm::dvec3& point : points) {
        if (const auto pixel = camera.pinhole.pixel(camera_from_table.point(point)); pixel) {
            low = glm::min(low, *pixel);
            high = glm::max(high, *pixel);
        }
    }
    geometry::Pinhole& pinhole = camera.pinhole;
    const glm::dvec2 size(pinhole.width, pinhole.height);
    const glm::dvec2 room = share * size / glm::max(high - low, glm::dvec2(1.0));
    const double zoom = std::min(room.x, room.y);
    const glm::dvec2 centre = size / 2.0 + zoom * (glm::dvec2(pinhole.cx, pinhole.cy) - (low + high) / 2.0);
    pinhole.fx *= zoom;
    pinhole.fy *= zoom;
    pinhole.cx = centre.x;
    pinhole.cy = centre.y;
}

std::vector<glm::dvec3> prop_corners(const simulation::VisitorScene& scene) {
    std::vector<glm::dvec3> corners;
    for (const glm::dvec3& corner : scene.prop.corners) {
        corners.push_back(scene.table_from_prop.point(corner));
    }
    return corners;
}

} // namespace

simulation::VisitorCamera framed_camera(const simulation::VisitorScene& scene, const glm::ivec2& size) {
    simulation::VisitorCamera camera =
        simulation::visitor_camera(scene.prop, scene.table_from_prop, scene.eye_m, size.x, size.y);
    frame(camera, prop_corners(scene), {1.0, prop_share_of_height});
    return camera;
}

simulation::VisitorCamera table_camera(const simulation::VisitorScene& scene, const glm::ivec2& size) {
    // For a prop in the table's middle, so the table stays still in the picture while the prop slides.
    simulation::VisitorCamera camera =
        simulation::visitor_camera(scene.prop, geometry::RigidTransform{}, scene.eye_m, size.x, size.y);
    std::vector<glm::dvec3> points = prop_corners(scene);
    for (const glm::dvec3& corner : lit_corners(scene)) {
        points.push_back(corner);
    }
    frame(camera, points, glm::dvec2(1.0));
    return camera;
}

simulation::VisitorCamera room_camera(const simulation::VisitorScene& scene, const glm::ivec2& size) {
    const glm::dvec3 prop = scene.table_from_prop.point(scene.prop.middle);
    simulation::VisitorCamera camera = simulation::visitor_camera(
        scene.prop, scene.table_from_prop, glm::mix(prop, scene.eye_m, behind_the_visitor), size.x, size.y);
    std::vector<glm::dvec3> points{scene.table_from_projector.translation + glm::dvec3(0.0, 0.0, 0.12)};
    for (const double side : {-0.5, 0.5}) {
        points.emplace_back(side * scene.table_size_m.x, -0.5 * scene.table_size_m.y, -0.2);
        points.emplace_back(side * scene.table_size_m.x, 0.5 * scene.table_size_m.y, 0.0);
    }
    frame(camera, points, glm::dvec2(seen_share));
    return camera;
}

std::vector<glm::dvec3> lit_corners(const simulation::VisitorScene& scene) {
    const glm::dvec2 size(scene.projector.width, scene.projector.height);
    std::vector<glm::dvec3> corners;
    for (const glm::dvec2 corner : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)}) {
        if (const auto lit =
                geometry::lights_table(scene.projector, scene.table_from_projector, corner * size)) {
            corners.emplace_back(*lit, 0.0);
        }
    }
    return corners;
}

std::vector<FaceOutline> face_outlines(const simulation::VisitorScene& scene) {
    const geometry::RigidTransform projector_from_prop =
        scene.table_from_projector.inverse() * scene.table_from_prop;
    std::vector<FaceOutline> outlines;
    for (const geometry::PropFace& face : scene.prop.faces) {
        FaceOutline outline;
        bool visible = true;
        for (const glm::dvec3& corner : face.corners) {
            const std::optional<glm::dvec2> pixel = scene.projector.pixel(projector_from_prop.point(corner));
            visible = visible && pixel.has_value();
            outline.push_back(pixel.value_or(glm::dvec2(0.0)));
        }
        if (visible) {
            outlines.push_back(outline);
        }
    }
    return outlines;
}

} // namespace frustumscreen::programs
