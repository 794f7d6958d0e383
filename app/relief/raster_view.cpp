#include "app/relief/raster_view.h"

#include "app/geometry/collineation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::relief {

namespace {

glm::dvec3 corner_of_box(const glm::dvec3& size, unsigned k) {
    return {(k & 1U) != 0 ? 0.5 * size.x : -0.5 * size.x, (k & 2U) != 0 ? 0.5 * size.y : -0.5 * size.y,
            (k & 4U) != 0 ? size.z : 0.0};
}

/// Bounding box of the artifact's box, in the prop frame.
geometry::Box placed_box(const RasterScene& scene) {
    geometry::Box box{glm::dvec3(std::numeric_limits<double>::infinity()),
                      glm::dvec3(-std::numeric_limits<double>::infinity())};
    for (unsigned k = 0; k < 8; ++k) {
        const glm::dvec3 corner(scene.prop_from_box * glm::dvec4(corner_of_box(scene.box_size, k), 1.0));
        box.low = glm::min(box.low, corner);
        box.high = glm::max(box.high, corner);
    }
    return box;
}

/// The projector's pixels around everything between two ideal pixels.
PixelRectangle pixels_between(glm::dvec2 low, glm::dvec2 high, const geometry::Pinhole& projector) {
    projector.bend_around(low, high);
    const auto clamped = [](double value, int most) {
        return static_cast<int>(std::clamp(value, 0.0, double(most)));
    };
    const int left = clamped(std::floor(low.x), projector.width);
    const int top = clamped(std::floor(low.y), projector.height);
    return {.x = left,
            .y = top,
            .width = clamped(std::ceil(high.x), projector.width) - left,
            .height = clamped(std::ceil(high.y), projector.height) - top};
}

/// The pixels around the box's corners; the whole picture if a corner is not in front of the eye.
PixelRectangle pixels_around(const RasterFace& face, const glm::dvec3& size,
                             const geometry::Pinhole& projector) {
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high = -low;
    for (unsigned k = 0; k < 8; ++k) {
        const glm::dvec3 at = face.pixel_from_box * glm::dvec4(corner_of_box(size, k), 1.0);
        if (!(at.z > 0.0)) {
            return {.x = 0, .y = 0, .width = projector.width, .height = projector.height};
        }
        low = glm::min(low, glm::dvec2(at) / at.z);
        high = glm::max(high, glm::dvec2(at) / at.z);
    }
    return pixels_between(low, high, projector);
}

/// The pixels around a face as the projector lights it; the whole picture if a corner is not in front of it.
PixelRectangle pixels_of(const geometry::PropFace& face, const RasterScene& scene) {
    const geometry::RigidTransform projector_from_prop = scene.prop_from_projector.inverse();
    const geometry::Pinhole ideal = scene.projector.ideal();
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high = -low;
    for (const glm::dvec3& corner : face.corners) {
        const std::optional<glm::dvec2> pixel = ideal.pixel(projector_from_prop.point(corner));
        if (!pixel) {
            return {.x = 0, .y = 0, .width = scene.projector.width, .height = scene.projector.height};
        }
        low = glm::min(low, *pixel);
        high = glm::max(high, *pixel);
    }
    return pixels_between(low, high, scene.projector);
}

/// Oriented so that the inside is positive, and scaled so that its value changes by 1 per pixel.
glm::dvec3 inward_edge(const glm::dvec3& edge) {
    return -edge / glm::length(glm::dvec2(edge));
}

} // namespace

void set_up(RasterView& view, const geometry::PropShape& prop, const RasterScene& scene) {
    const glm::dmat4 box_from_prop = glm::inverse(scene.prop_from_box);
    const int width = scene.projector.width;
    const int height = scene.projector.height;
    const glm::dmat4 clip_from_prop =
        scene.projector.clip_from_point() * scene.prop_from_projector.inverse().matrix();
    // Rows (x + w) / 2 W, (y + w) / 2 H and w of clip coordinates.
    const glm::mat<4, 3, double> pixel_from_clip(glm::dvec3(0.5 * width, 0.0, 0.0),
                                                 glm::dvec3(0.0, 0.5 * height, 0.0), glm::dvec3(0.0),
                                                 glm::dvec3(0.5 * width, 0.5 * height, 1.0));
    const geometry::Box box = placed_box(scene);
    view.eye_box = glm::dvec3(box_from_prop * glm::dvec4(scene.eye_m, 1.0));
    view.faces.clear();
    view.lit = {};
    view.projector = scene.projector;
    for (std::size_t k = 0; k < prop.faces.size(); ++k) {
        const geometry::PropFace& face = prop.faces[k];
        if (!(face.plane.distance(scene.prop_from_projector.translation) > 0.0)) {
            continue;
        }
        const std::optional<glm::dmat4> clip =
            geometry::collineation(face.plane, scene.eye_m, clip_from_prop, box);
        if (!clip) {
            continue;
        }
        const geometry::FaceRays rays =
            geometry::face_rays(face, scene.projector.ideal(), scene.prop_from_projector, scene.eye_m);
        RasterFace face_view;
        face_view.face = static_cast<int>(k);
        face_view.direction = glm::dmat3(box_from_prop) * rays.direction;
        face_view.slant = rays.slant;
        for (const glm::dvec3& edge : rays.edges) {
            face_view.edges.push_back(inward_edge(edge));
        }
        face_view.pixel_from_box = pixel_from_clip * *clip * scene.prop_from_box;
        face_view.lit =
            intersected(pixels_around(face_view, scene.box_size, scene.projector), pixels_of(face, scene));
        if (!face_view.lit.empty()) {
            view.lit = united(view.lit, face_view.lit);
            view.faces.push_back(face_view);
        }
    }
}

} // namespace frustumscreen::relief
