#include "app/bench/techniques/relief_raster.h"

#include "assets_baked/bake/block_relief.h"
#include "assets_baked/bake/level.h"

#include <algorithm>

namespace frustumscreen {

BlockRelief blocks_of_pack(const Pack& pack, int texels) {
    const auto finest = std::find_if(pack.levels.rbegin(), pack.levels.rend(), [](const PackLevel& level) {
        return level.technique == LevelTechnique::Mesh;
    });
    const PackLevel& level = finest != pack.levels.rend() ? *finest : pack.levels.back();
    Image8 texture = pack.textures[level.texture];
    for (int each = pack.relief_size; each >= 2 * texels; each /= 2) {
        texture = half_size(texture); // keeps every texel's contribution
    }
    const SourceMesh mesh = textured_source(level, texture, pack.box_size);
    const SourceScene surface(mesh, mesh.positions, Sides::Front);
    const std::vector<ReliefDirection> directions = {ReliefDirection::PlusX, ReliefDirection::MinusX,
                                                     ReliefDirection::PlusY, ReliefDirection::MinusY,
                                                     ReliefDirection::PlusZ};
    return bake_blocks({surface, pack.box_size, directions, texels});
}

} // namespace frustumscreen
