/// What the GPU's memory takes of a level, ready to be copied there: vertices and the texture's mip levels.
///
/// Colour   sRGB codes as they are stored; mip levels are averaged in linear light, here and not by the driver:
///          so they are the same everywhere, and the finest need not be there to make the others.
/// Threads  pure; any: all of the work is done here, and uploading is copying.
/// Errors   none.
#pragma once

#include "app/image/image.h"
#include "app/pack/pack.h"
#include "app/relief/block_relief.h"
#include "app/scene/scene_level.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace frustumscreen {

struct LevelData {
    std::vector<PackVertex> vertices;
    std::vector<Image8> mips; ///< finest first, those that are uploaded
    int finest_mip = 0;       ///< of the whole texture: which one `mips` begins with
    double texels_per_box = 0.0;
    bool cut_out = false;
    /// In the stead of all that: it stays in main memory.
    std::shared_ptr<const BlockRelief> relief{};
    bool on_gpu = false; ///< the relief, which goes into the GPU's memory too, for it to draw
};
/// `texture`: the level's whole texture.
[[nodiscard]] LevelData level_data(const SceneLevel& level, const Image8& texture);

} // namespace frustumscreen
