/// The errors of an artifact's levels and reliefs as eyes all around see them, measured by the bake along the eyes'
/// rays: a pack's sections `seen_errors` and `seen_reliefs` (FORMAT.md).
///
/// Frame    box; box units.
/// Errors   one line beginning with the field's place in the manifest.
/// Threads  values; any.
#pragma once

#include "app/pack/pack.h"
#include "firmware_host/base/result.h"

#include <array>
#include <cstddef>
#include <vector>

namespace frustumscreen::pack {

/// An eye sees the artifact in patches: a grid of 4 x 4 over the rectangle that encloses the box in the eye's view.
inline constexpr std::size_t seen_patches = 16;

struct SeenPatch {
    glm::dvec3 place{0.0}; ///< the mean of the points that its rays hit
    double share = 0.0;    ///< of the rays that hit the artifact
};
struct SeenEye {
    glm::dvec3 towards{0.0, 0.0, 1.0}; ///< unit, from the box's middle
    /// How far a ray's hit moves along the surface, and over edges onto what they hide, when the ray moves, divided
    /// by the movement of the ray. 1 for a plane that faces the eye; pi / 2 for a ball and parallel rays.
    float steepness = 1.0F;
    std::array<SeenPatch, seen_patches> patches{};
};

/// The errors of one level as one eye sees them.
struct SeenError {
    float mean_box = 0.0F; ///< expected distance between a ray's hits on the level and on the source
    float p95_box = 0.0F;
    /// The width of an even band along the source's outline with the area of the rays that hit only one of the two.
    float outline_shift_box = 0.0F;
    float silhouette_share = 0.0F;                 ///< these rays, divided by those that hit both
    std::array<float, seen_patches> patches_box{}; ///< the mean of each patch's rays
};

struct SeenErrors {
    std::vector<SeenEye> eyes;
    std::vector<std::vector<SeenError>> levels;  ///< for each level, for each eye
    std::vector<std::vector<SeenError>> reliefs; ///< for each relief to be rasterized, for each eye
};

/// The pack must not have the sections yet.
void put_seen_errors(const SeenErrors& seen, PackDescription& pack);
/// Empty for a pack without `seen_errors`; without `seen_reliefs`, only `reliefs` is empty. `levels`: of the pack.
[[nodiscard]] Result<SeenErrors> seen_errors_of(const PackDescription& pack, std::size_t levels);

} // namespace frustumscreen::pack
