/// A pinhole projector or camera with lens shift and optional distortion: u = fx x + cx, v = fy y + cy, where
/// (x, y) is (X/Z, Y/Z) after distortion.
///
/// Frame    computer vision: +X right, +Y down in the picture, +Z forward along the optical axis.
/// Units    pixels; the centre of the top-left pixel is (0.5, 0.5). Lens shift is an off-centre (cx, cy).
/// Threads  values; any.
#pragma once

#include "app/geometry/lens.h"

#include <glm/glm.hpp>

#include <optional>

namespace frustumscreen::geometry {

struct Pinhole {
    int width = 0;
    int height = 0;
    double fx = 0.0;
    double fy = 0.0;
    double cx = 0.0;
    double cy = 0.0;
    Lens lens{};

    [[nodiscard]] bool operator==(const Pinhole&) const = default;
    /// Pixel of a point in the pinhole's frame; nullopt if the point is not in front, or is beyond the lens's
    /// fold.
    [[nodiscard]] std::optional<glm::dvec2> pixel(const glm::dvec3& point) const;
    /// Direction (not unit, Z = 1) of the ray through a pixel. Beyond the fold, where no ray goes through it,
    /// that of the ideal lens.
    [[nodiscard]] glm::dvec3 ray(const glm::dvec2& pixel) const;
    /// An equal view in a picture of another size.
    [[nodiscard]] Pinhole scaled_to(int new_width, int new_height) const;
    /// This projector or camera with a lens that does not distort.
    [[nodiscard]] Pinhole ideal() const;
    /// r^2 of the farthest ideal direction in the picture.
    [[nodiscard]] double farthest_r2() const;
    /// r^2 of ideal directions up to which drawing bends: beyond the picture, as far as the settings' check
    /// reaches. Farther out the factor stays constant, so that nothing folds back into the picture.
    [[nodiscard]] double bends_to_r2() const { return 1.05 * farthest_r2(); }
    /// Widens a rectangle in pixels of the ideal pinhole to a conservative bound of its distorted image.
    void bend_around(glm::dvec2& low, glm::dvec2& high) const;
    /// For the ideal pinhole: rows 0, 1, 3 of the OpenGL clip matrix for points in the pinhole's frame. The y
    /// row is NOT mirrored for GL: clip y = -1 is the top of the picture, so that row 0 of a read-back is the
    /// picture's top row. Row 2 (depth) is zero: the caller fits it to the drawn depth range.
    [[nodiscard]] glm::dmat4 clip_from_point() const;
};

} // namespace frustumscreen::geometry
