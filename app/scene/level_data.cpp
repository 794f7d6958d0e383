#include "app/scene/level_data.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace frustumscreen::scene {

LevelData mesh_data(const SceneLevel& level) {
    return {.vertices = level.mesh.vertices,
            .mips = {},
            .finest_mip = level.finest_mip,
            .texels_per_box = level.texels_per_box,
            .cut_out = level.cut_out,
            .relief = {},
            .on_gpu = false};
}

LevelData level_data(const SceneLevel& level, const image::Image8& texture) {
    LevelData data = mesh_data(level);
    image::Image8 mip = level.finest_mip > 0 ? image::half_size(texture) : texture;
    for (int k = 1; k < level.finest_mip; ++k) {
        mip = image::half_size(mip);
    }
    const auto longest = static_cast<unsigned>(std::max(mip.width, mip.height));
    const int levels =
        std::min(static_cast<int>(std::bit_width(longest)), coarsest_mip_level + 1 - level.finest_mip);
    data.mips.reserve(static_cast<std::size_t>(std::max(levels, 1)));
    data.mips.push_back(std::move(mip));
    for (int k = 1; k < levels; ++k) {
        data.mips.push_back(image::half_size(data.mips.back()));
    }
    return data;
}

} // namespace frustumscreen::scene
