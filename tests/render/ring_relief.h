/// A relief of a synthetic pack's only level, in a frustum's directions, or in all.
#pragma once

#include "assets_baked/bake/block_relief.h"
#include "assets_baked/bake/level.h"
#include "tests/render/synthetic_pack.h"

#include <memory>

namespace frustumscreen::synthetic {

inline std::shared_ptr<const relief::BlockRelief> relief_of(const pack::Pack& pack, int texels,
                                                            bool from_below = false) {
    const bake::SourceMesh mesh = bake::textured_source(pack.levels[0], pack.textures[0], pack.box_size);
    const bake::SourceScene surface(mesh, mesh.positions, bake::Sides::Front);
    std::vector<pack::ReliefDirection> directions{pack::ReliefDirection::PlusX, pack::ReliefDirection::MinusX,
                                                  pack::ReliefDirection::PlusY, pack::ReliefDirection::MinusY,
                                                  pack::ReliefDirection::PlusZ};
    if (from_below) {
        directions.push_back(pack::ReliefDirection::MinusZ);
    }
    return std::make_shared<const relief::BlockRelief>(
        bake::bake_blocks({surface, pack.box_size, directions, texels}));
}

} // namespace frustumscreen::synthetic
