/// A relief of a synthetic pack's only level, in a frustum's directions.
#pragma once

#include "assets_baked/bake/block_relief.h"
#include "assets_baked/bake/level.h"
#include "tests/render/synthetic_pack.h"

#include <memory>

namespace frustumscreen::synthetic {

inline std::shared_ptr<const BlockRelief> relief_of(const Pack& pack, int texels) {
    const SourceMesh mesh = textured_source(pack.levels[0], pack.textures[0], pack.box_size);
    const SourceScene surface(mesh, mesh.positions, Sides::Front);
    return std::make_shared<const BlockRelief>(
        bake_blocks({surface,
                     pack.box_size,
                     {ReliefDirection::PlusX, ReliefDirection::MinusX, ReliefDirection::PlusY,
                      ReliefDirection::MinusY, ReliefDirection::PlusZ},
                     texels}));
}

} // namespace frustumscreen::synthetic
