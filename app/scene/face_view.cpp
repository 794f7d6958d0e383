#include "app/scene/face_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace frustumscreen::scene {

namespace {

glm::dvec4 row(const glm::dmat4& m, int r) {
    return {m[0][r], m[1][r], m[2][r], m[3][r]};
}

/// Pixels around points of the box seen through a face.
template <std::size_t count>
PixelRectangle pixels_of(const std::array<glm::vec3, count>& points, const glm::mat4& clip_from_box,
                         const geometry::Pinhole& pinhole) {
    std::array<glm::dvec4, count> clip;
    for (std::size_t k = 0; k < count; ++k) {
        clip[k] = glm::dvec4(clip_from_box * glm::vec4(points[k], 1.0F));
    }
    return pixels_around(clip, pinhole);
}

std::array<glm::vec3, 8> corners_of(const LevelTriangles::Extent& extent) {
    std::array<glm::vec3, 8> corners{};
    for (std::size_t k = 0; k < corners.size(); ++k) {
        corners[k] = {(k & 1U) != 0 ? extent.high.x : extent.low.x,
                      (k & 2U) != 0 ? extent.high.y : extent.low.y,
                      (k & 4U) != 0 ? extent.high.z : extent.low.z};
    }
    return corners;
}

/// Clip coordinates around everything that the lens maps into the picture; -1 and 1 without distortion.
std::pair<glm::dvec2, glm::dvec2> ideal_edges(const geometry::Pinhole& pinhole) {
    glm::dvec2 low(-1.0);
    glm::dvec2 high(1.0);
    if (!pinhole.lens.is_plain()) {
        const auto [least, most] = pinhole.lens.factors_within(pinhole.farthest_r2());
        const glm::dvec2 size(pinhole.width, pinhole.height);
        const glm::dvec2 centre = 2.0 * glm::dvec2(pinhole.cx, pinhole.cy) / size - 1.0;
        low = centre + glm::min((low - centre) / least, (low - centre) / most);
        high = centre + glm::max((high - centre) / least, (high - centre) / most);
    }
    return {low, high};
}

} // namespace

PixelRectangle pixels_around(std::span<const glm::dvec4> clip, const geometry::Pinhole& pinhole) {
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high(-std::numeric_limits<double>::infinity());
    const glm::dvec2 size(pinhole.width, pinhole.height);
    for (const glm::dvec4& p : clip) {
        if (!(p.w > 0.0)) {
            return {.x = 0, .y = 0, .width = pinhole.width, .height = pinhole.height};
        }
        const glm::dvec2 pixel = (glm::dvec2(p) / p.w * 0.5 + 0.5) * size;
        low = glm::min(low, pixel);
        high = glm::max(high, pixel);
    }
    pinhole.bend_around(low, high);
    low = glm::clamp(glm::floor(low) - 1.0, glm::dvec2(0.0), size);
    high = glm::clamp(glm::ceil(high) + 1.0, glm::dvec2(0.0), size);
    return {.x = static_cast<int>(low.x),
            .y = static_cast<int>(low.y),
            .width = static_cast<int>(high.x - low.x),
            .height = static_cast<int>(high.y - low.y)};
}

PixelRectangle face_bounds(const geometry::PropFace& face, const geometry::Box& box,
                           const glm::dmat4& clip_from_prop, const glm::dmat4& clip_through_face,
                           const geometry::Pinhole& pinhole) {
    geometry::PerCorner<glm::dvec4> outline;
    for (const glm::dvec3& corner : face.corners) {
        outline.push_back(clip_from_prop * glm::dvec4(corner, 1.0));
    }
    std::array<glm::dvec4, 8> corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const glm::dvec3 corner((k & 1U) != 0 ? box.high.x : box.low.x,
                                (k & 2U) != 0 ? box.high.y : box.low.y,
                                (k & 4U) != 0 ? box.high.z : box.low.z);
        corners[k] = clip_through_face * glm::dvec4(corner, 1.0);
    }
    return intersected(pixels_around(outline, pinhole), pixels_around(corners, pinhole));
}

glm::vec4 corner_in_clip(const glm::dvec3& corner, const glm::dmat4& clip) {
    const glm::dvec4 at = clip * glm::dvec4(corner, 1.0);
    return glm::vec4(glm::dvec4(at.x, at.y, 0.0, at.w));
}

FaceVolume volume_of(const geometry::PropFace& face, const glm::dvec3& eye_in_prop,
                     const glm::dmat4& placed_from_prop, double metres_per_box,
                     const glm::dmat4& clip_from_box, const geometry::Pinhole& pinhole) {
    FaceVolume volume;
    const auto in_box = [&](const glm::dvec3& in_prop) {
        return glm::dvec3(placed_from_prop * glm::dvec4(in_prop, 1.0)) / metres_per_box;
    };
    const double side = glm::determinant(glm::dmat3(placed_from_prop)) < 0.0 ? -1.0 : 1.0;
    const glm::dvec3 eye = in_box(eye_in_prop);
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
        const glm::dvec3 a = in_box(face.corners[k]) - eye;
        const glm::dvec3 b = in_box(face.corners[face.corners.next(k)]) - eye;
        const glm::dvec3 inward = side * glm::cross(b, a);
        volume.add(glm::dvec4(inward, -glm::dot(inward, eye)));
    }
    const glm::dvec4 w = row(clip_from_box, 3);
    volume.add(w);
    const auto [low, high] = ideal_edges(pinhole);
    for (int axis = 0; axis < 2; ++axis) {
        volume.add(row(clip_from_box, axis) - low[axis] * w);
        volume.add(high[axis] * w - row(clip_from_box, axis));
    }
    return volume;
}

PixelRectangle light_tiles(const LevelTriangles& level, std::size_t cluster,
                           std::span<const std::uint32_t> visible, const glm::mat4& clip_from_box,
                           const PixelRectangle& face, const geometry::Pinhole& pinhole, LitTiles& tiles) {
    constexpr int pixels_per_triangle = 100; // below this a test per triangle costs more than it saves
    const PixelRectangle box =
        intersected(face, pixels_of(corners_of(level.extents[cluster]), clip_from_box, pinhole));
    const std::size_t triangles = visible.size() / 3;
    if (box.empty() || static_cast<std::size_t>(box.width) * static_cast<std::size_t>(box.height) <=
                           pixels_per_triangle * triangles) {
        tiles.light(box);
        return box;
    }
    PixelRectangle bounds;
    for (std::size_t k = 0; k < visible.size(); k += 3) {
        const std::array<glm::vec3, 3> corners{level.positions[visible[k]], level.positions[visible[k + 1]],
                                               level.positions[visible[k + 2]]};
        const PixelRectangle part = intersected(face, pixels_of(corners, clip_from_box, pinhole));
        tiles.light(part);
        bounds = united(bounds, part);
    }
    return bounds;
}

double pixels_per_unit(const glm::dmat4& clip_from_box, const glm::dvec3& point,
                       const geometry::Pinhole& pinhole) {
    const glm::dvec4 clip = clip_from_box * glm::dvec4(point, 1.0);
    if (!(clip.w > 0.0)) {
        return 0.0;
    }
    const glm::dvec3 w(row(clip_from_box, 3));
    const glm::dvec3 across =
        0.5 * pinhole.width / clip.w * (glm::dvec3(row(clip_from_box, 0)) - clip.x / clip.w * w);
    const glm::dvec3 down =
        0.5 * pinhole.height / clip.w * (glm::dvec3(row(clip_from_box, 1)) - clip.y / clip.w * w);
    return std::sqrt(glm::length(glm::cross(across, down)));
}

/// Clip w of E + s (S - E) is s w(S), and w(S) is a constant of the face divided by -n.L: so z / w = a + b / w is linear
/// in L / s. The constant is found at a corner of the face, where S is known.
glm::vec4 depth_from_nearness(const geometry::PropFace& face, const glm::dmat4& clip_from_prop,
                              const glm::dmat4& projector_from_prop) {
    const glm::dvec3 slant = -glm::dmat3(projector_from_prop) * face.plane.normal; // times L: -n.L
    const glm::dvec3 corner(projector_from_prop * glm::dvec4(face.corners[0], 1.0));
    const double w = (clip_from_prop * glm::dvec4(face.corners[0], 1.0)).w;
    const double w_slant = w * glm::dot(slant, corner) / corner.z;
    // The collineation's depth row is a times its w row, and b more in the last column.
    const glm::dvec3 w_row(clip_from_prop[0].w, clip_from_prop[1].w, clip_from_prop[2].w);
    const glm::dvec3 z_row(clip_from_prop[0].z, clip_from_prop[1].z, clip_from_prop[2].z);
    const double a = glm::dot(z_row, w_row) / glm::dot(w_row, w_row);
    const double b = clip_from_prop[3].z - a * clip_from_prop[3].w;
    return {glm::vec3(b / w_slant * slant), static_cast<float>(a)};
}

} // namespace frustumscreen::scene
