/// Relief textures on the faces of a box around the object, which the peers march through and warp.
///
/// One orthographic image per face of the prop, along the box axis nearest to the face's normal: the first
/// hit's colour and depth, seen from outside through the middle of each texel.
///
/// Frame    box coordinates: 0..1 from the box's low to its high corner, the box in the prop's frame, metres.
///          An image along axis a has the other two axes, in ascending order, as its columns and rows: texel
///          (i, j) has its middle at ((i + 0.5) / texels, (j + 0.5) / texels).
/// Shape    every image is [texels][texels], row-major.
/// Threads  values; `rasterize_relief_images` uses every core inside.
/// Source   Oliveira, Bishop & McAllister, Relief texture mapping, 2000; Kim, Shin & Kim, Using relief
///          texture for interactive and tangible virtual environments, 2008.
#pragma once

#include "app/bench/truth/truth.h"
#include "app/geometry/collineation.h"

#include <array>
#include <cstdint>
#include <vector>

namespace frustumscreen::bench {

inline constexpr std::uint16_t no_depth = 65535;
inline constexpr double depth_codes = 65534.0; ///< per box length

struct ReliefImage {
    int axis = 0;     ///< 0 x, 1 y, 2 z
    bool high = true; ///< looks at the box's high side, against the axis
    /// sRGB; alpha 1..255: the cosine between the surface's normal and the line of sight; 0 = no hit; around
    /// hits, their colours continue for a few texels.
    image::Image8 colour;
    image::Image16 depth; ///< from the box's side, in 1 / depth_codes of the box; no_depth = no hit
};

struct ReliefImages {
    geometry::Box box; ///< with an empty margin of texels around the artifact
    int texels = 0;
    std::vector<ReliefImage> images; ///< one per face of the prop, in that order
};

/// The axes of an image's columns and rows.
[[nodiscard]] constexpr std::array<int, 2> image_axes(int axis) {
    return {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
}

/// The placed mesh's box.
[[nodiscard]] geometry::Box placed_box(const bake::SourceMesh& mesh, const glm::dmat4& prop_from_artifact);

/// `artifact`: its box in the prop's frame. At least 8 texels.
[[nodiscard]] ReliefImages rasterize_relief_images(const Truth& truth, const geometry::Box& artifact,
                                                   const geometry::PropShape& prop, int texels);

/// Dual-depth relief (Policarpo, Oliveira & Comba 2005): where material may be along an axis, from the two
/// images that look along it; codes 0..65535 of box coordinates, (65535, 0) = no material. A side without an
/// image counts as solid up to the box's end.
[[nodiscard]] image::Image<glm::u16vec2> material_along(const ReliefImages& images, int axis);

} // namespace frustumscreen::bench
