/// The eyes of a patch, and the part of a world that they see.
///
/// Frames   window (triangle_world.h); patch: the axes of the patch's image plane, metres, origin in the window's middle. Depths
///          are multiplied by the sine of the largest angle between a ray that the patch shows and the plane's normal: what is
///          steep to the plane is seen that much shorter, so it needs no more texels.
/// Threads  values; any.
#pragma once

#include "app/ldi/hemisphere.h"
#include "app/ldi/triangle_world.h"
#include "app/ldi/window_clip.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace frustumscreen::ldi {

/// Directions of a patch's grids, as axes of the patch frame: +x, -x, +y, -y, +z, -z.
inline constexpr std::size_t grid_directions = 6;
inline constexpr std::size_t toward_eyes = 4;

/// A triangle that some eye of the patch may see.
struct FacingTriangle {
    std::uint32_t triangle = 0;
    std::uint8_t drawn = 0; ///< bit k: direction k crosses it
    std::uint8_t own = 0;   ///< bit k: and draws it
};

class PatchView {
public:
    PatchView(const Hemisphere& hemisphere, std::size_t patch, const glm::dvec2& half_extent_m,
              double texel_m);

    [[nodiscard]] const glm::dmat3& patch_from_window() const { return patch_from_window_; }
    [[nodiscard]] const WindowClip& clip() const { return clip_; }

    /// A triangle's share of the directions; `drawn` is 0 if no eye may see it. Its indices must be valid.
    [[nodiscard]] FacingTriangle facing(const TriangleWorld& world, std::uint32_t triangle) const;
    /// Enlarges the box around what may be seen of the triangle, patch frame.
    void widen(const TriangleWorld& world, std::uint32_t triangle, glm::dvec3& low, glm::dvec3& high) const;

private:
    /// 1: the side that its corners run around counter-clockwise faces all eyes; 2: the other; 3: each some eye.
    [[nodiscard]] unsigned sides_seen(const glm::dvec3& normal, const glm::dvec3& corner) const;

    glm::dmat3 patch_from_window_{1.0};
    WindowClip clip_;
    double margin_m_;
    double radius_m_;
    glm::dvec3 axis_;
    double cone_cos_, cone_sin_;
};

} // namespace frustumscreen::ldi
