/// Layered relief cast through blocks on every core, by the exhibit's own painter: what relief textures cost without triangles.
///
/// Colour   of the surface, unlit; sRGB codes, bilinear between the relief's texels.
/// Threads  the one whose context is current; the stage must outlive the technique.
#pragma once

#include "app/bench/techniques/technique.h"
#include "app/pack/pack.h"
#include "app/relief/block_relief.h"
#include "assets_baked/bake/source_mesh.h"

#include <memory>
#include <vector>

namespace frustumscreen {

struct BlocksInBox {
    BlockRelief relief;
    glm::dvec3 box_size{1.0};
    glm::dmat4 prop_from_box{1.0};
};

/// Errors: the driver has no memory.
[[nodiscard]] Result<std::unique_ptr<Technique>> make_relief_cast(const Stage& stage, BlocksInBox blocks,
                                                                  int samples);

/// The source's front sides in the directions of a frustum's faces. `texels` along the longest edge.
[[nodiscard]] BlocksInBox blocks_of_source(const SourceMesh& mesh, const PackDescription& pack,
                                           const PropShape& prop, int texels);

} // namespace frustumscreen
