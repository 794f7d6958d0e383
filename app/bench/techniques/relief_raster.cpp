#include "app/bench/techniques/relief_raster.h"

#include "assets_baked/bake/block_relief.h"
#include "assets_baked/bake/level.h"

#include <algorithm>

namespace frustumscreen::bench {

relief::BlockRelief blocks_of_pack(const pack::Pack& pack, int texels) {
    const auto finest =
        std::find_if(pack.levels.rbegin(), pack.levels.rend(), [](const pack::PackLevel& level) {
            return level.technique == pack::LevelTechnique::Mesh;
        });
    const pack::PackLevel& level = finest != pack.levels.rend() ? *finest : pack.levels.back();
    image::Image8 texture = pack.textures[level.texture];
    for (int each = pack.relief_size; each >= 2 * texels; each /= 2) {
        texture = image::half_size(texture); // keeps every texel's contribution
    }
    const bake::SourceMesh mesh = bake::textured_source(level, texture, pack.box_size);
    const bake::SourceScene surface(mesh, mesh.positions, bake::Sides::Front);
    const std::vector<pack::ReliefDirection> directions = {
        pack::ReliefDirection::PlusX, pack::ReliefDirection::MinusX, pack::ReliefDirection::PlusY,
        pack::ReliefDirection::MinusY, pack::ReliefDirection::PlusZ};
    return bake::bake_blocks(
        {.surface = surface, .box_size = pack.box_size, .directions = directions, .texels = texels});
}

} // namespace frustumscreen::bench
