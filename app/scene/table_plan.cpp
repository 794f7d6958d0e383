#include "app/scene/table_plan.h"

#include "app/geometry/corner_fan.h"
#include "app/scene/face_view.h"

#include <algorithm>
#include <array>

namespace frustumscreen::scene {

namespace {

/// A quadrilateral with a picture, or black.
Draw draw_flat(const std::array<glm::dvec3, 4>& outline, const glm::dmat4& clip, TextureId texture,
               double brightness, const PixelRectangle& bounds) {
    std::array<glm::vec4, 4> columns{};
    std::transform(outline.begin(), outline.end(), columns.begin(),
                   [&](const glm::dvec3& corner) { return corner_in_clip(corner, clip); });
    Draw draw;
    draw.shader = {ShaderKey::Pass::TablePicture};
    draw.drawable.material.texture = texture;
    draw.clip_from_unit = glm::mat4(columns[0], columns[1], columns[2], columns[3]);
    draw.brightness = static_cast<float>(brightness);
    draw.bounds = bounds;
    return draw;
}

PixelRectangle bounds_of(const std::array<glm::dvec3, 4>& outline, const glm::dmat4& clip,
                         const geometry::Pinhole& projector) {
    std::array<glm::dvec4, 4> corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        corners[k] = clip * glm::dvec4(outline[k], 1.0);
    }
    return pixels_around(corners, projector);
}

/// The lit faces of a shape, where they may meet `pictures`.
void add_black(const geometry::PropShape& shape, const geometry::RigidTransform& projector_from_shape,
               const PixelRectangle& pictures, const geometry::Pinhole& pinhole, FramePlan& plan) {
    const glm::dmat4 clip = pinhole.clip_from_point() * projector_from_shape.matrix();
    const glm::dvec3 projector = projector_from_shape.inverse().translation;
    for (const geometry::PropFace& face : shape.faces) {
        if (!(face.plane.distance(projector) > 0.0)) {
            continue;
        }
        for (std::size_t k = 0; k < geometry::fan_quads(face.corners.size()); ++k) {
            const auto [a, b, c, d] = geometry::fan_quad(face.corners.size(), k);
            const std::array<glm::dvec3, 4> part{face.corners[a], face.corners[b], face.corners[c],
                                                 face.corners[d]};
            const PixelRectangle own = intersected(pictures, bounds_of(part, clip, pinhole));
            if (!own.empty()) {
                plan.draws.push_back(draw_flat(part, clip, TextureId::None, 0.0, own));
            }
        }
    }
}

} // namespace

void plan_table(const geometry::PropShape& prop, const PlanView& view, FramePlan& plan) {
    const geometry::RigidTransform projector_from_table = view.table_from_projector.inverse();
    const glm::dmat4 clip_from_table = view.projector.clip_from_point() * projector_from_table.matrix();
    PixelRectangle bounds;
    const auto add = [&](const TablePicture& picture) {
        const PixelRectangle own = bounds_of(picture.corners_m, clip_from_table, view.projector);
        if (picture.brightness > 0.0 && !own.empty()) {
            plan.draws.push_back(
                draw_flat(picture.corners_m, clip_from_table, picture.texture, picture.brightness, own));
            bounds = united(bounds, own);
        }
    };
    for (const TablePicture& picture : view.on_table) {
        if (!picture.on_prop) {
            add(picture);
        }
    }
    if (view.caption) {
        add(*view.caption);
    }
    if (!bounds.empty()) {
        for (const PlacedWindow& window :
             view.windows.first(std::min(view.windows.size(), plan.windows.size()))) {
            if (window.brightness > 0.0) {
                add_black(*window.surface, projector_from_table * window.table_from_window, bounds,
                          view.projector, plan);
            }
        }
        add_black(prop, projector_from_table * view.table_from_prop, bounds, view.projector, plan);
    }
    for (const TablePicture& picture : view.on_table) {
        if (picture.on_prop) {
            add(picture);
        }
    }
}

} // namespace frustumscreen::scene
