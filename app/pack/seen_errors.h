/// What eyes all around an artifact see of the errors of its levels and reliefs, as the bake measured it along their rays: a pack's
/// sections `seen_errors` and `seen_reliefs` (FORMAT.md).
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

namespace frustumscreen {

/// An eye sees the artifact in patches: a grid of 4 x 4 over the rectangle around the box, as the eye sees it.
inline constexpr std::size_t seen_patches = 16;

struct SeenPatch {
    glm::dvec3 place{0.0}; ///< the mean of what its rays meet
    double share = 0.0;    ///< of the rays that meet the artifact
};
struct SeenEye {
    glm::dvec3 towards{0.0, 0.0, 1.0}; ///< unit, from the box's middle
    /// By how much what a ray meets moves along the surface, and over edges onto what these hide, when the ray moves: over
    /// the ray's own way. 1 for a plane that faces the eye; pi / 2 for a ball and endless rays.
    float steepness = 1.0F;
    std::array<SeenPatch, seen_patches> patches{};
};

/// What one eye sees of a level.
struct SeenError {
    float mean_box = 0.0F; ///< to be expected between what a ray meets on the level and on the source
    float p95_box = 0.0F;
    /// The width of an even band along the source's outline made of the rays that meet only one of the two.
    float outline_shift_box = 0.0F;
    float silhouette_share = 0.0F;                 ///< the same rays, over those that meet both
    std::array<float, seen_patches> patches_box{}; ///< the mean of each patch's rays
};

struct SeenErrors {
    std::vector<SeenEye> eyes;
    std::vector<std::vector<SeenError>> levels;  ///< of each level, of each eye
    std::vector<std::vector<SeenError>> reliefs; ///< of each relief to be cast, of each eye
};

/// The pack must not have them yet.
void put_seen_errors(const SeenErrors& seen, PackDescription& pack);
/// Empty in older packs, or without reliefs alone. `levels`: that the pack has.
[[nodiscard]] Result<SeenErrors> seen_errors_of(const PackDescription& pack, std::size_t levels);

} // namespace frustumscreen
