#include "app/scene/level_data.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace frustumscreen {

LevelData level_data(const SceneLevel& level, const Image8& texture) {
    LevelData data{level.mesh.vertices, {}, level.finest_mip, level.texels_per_box, level.cut_out, {}, false};
    Image8 mip = level.finest_mip > 0 ? half_size(texture) : texture;
    for (int k = 1; k < level.finest_mip; ++k) {
        mip = half_size(mip);
    }
    const auto longest = static_cast<unsigned>(std::max(mip.width, mip.height));
    const int levels =
        std::min(static_cast<int>(std::bit_width(longest)), coarsest_mip_level + 1 - level.finest_mip);
    data.mips.reserve(static_cast<std::size_t>(std::max(levels, 1)));
    data.mips.push_back(std::move(mip));
    for (int k = 1; k < levels; ++k) {
        data.mips.push_back(half_size(data.mips.back()));
    }
    return data;
}

} // namespace frustumscreen
