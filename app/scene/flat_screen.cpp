#include "app/scene/flat_screen.h"

namespace frustumscreen::scene {

FlatScreen flat_screen(const std::array<glm::dvec3, 4>& corners_m, int width, int height) {
    const auto& [top_left, top_right, bottom_right, bottom_left] = corners_m;
    // Means of opposite sides: a measured rectangle is never quite one.
    const glm::dvec3 across = 0.5 * (top_right - top_left + bottom_right - bottom_left);
    const glm::dvec3 along = 0.5 * (bottom_left - top_left + bottom_right - top_right);
    const glm::dvec3 right = glm::normalize(across);
    const glm::dvec3 normal = glm::normalize(glm::cross(along, across)); // out of the screen
    const glm::dvec3 down = glm::cross(right, normal);
    const glm::dvec3 middle = 0.25 * (top_left + top_right + bottom_right + bottom_left);

    FlatScreen screen;
    geometry::PropFace& face = screen.surface.faces.emplace_back();
    face.name = "screen";
    face.plane = {normal, glm::dot(normal, middle)};
    const glm::dvec3 half_across = 0.5 * glm::length(across) * right;
    const glm::dvec3 half_down = 0.5 * glm::length(along) * down;
    for (const glm::dvec2& side :
         {glm::dvec2(-1, 1), glm::dvec2(1, 1), glm::dvec2(1, -1), glm::dvec2(-1, -1)}) {
        face.corners.push_back(middle + side.x * half_across + side.y * half_down);
    }
    screen.surface.bounds = {face.plane};
    screen.surface.corners.assign(face.corners.begin(), face.corners.end());
    screen.surface.middle = middle;

    // Any distance maps the panel exactly. From nearer than every eye, an object deep in the room does not count as shown by fewer
    // pixels than the panel has (pixel_density.h), so it keeps the requested samples.
    const double distance = 0.01 * (glm::length(across) + glm::length(along));
    screen.pinhole = {.width = width,
                      .height = height,
                      .fx = width * distance / glm::length(across),
                      .fy = height * distance / glm::length(along),
                      .cx = 0.5 * width,
                      .cy = 0.5 * height};
    screen.table_from_pinhole = {glm::normalize(glm::quat_cast(glm::dmat3(right, down, -normal))),
                                 middle + distance * normal};
    return screen;
}

} // namespace frustumscreen::scene
