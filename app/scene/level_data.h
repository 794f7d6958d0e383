/// A level's data for the GPU's memory, ready to copy: vertices and the texture's mip levels.
///
/// Colour   sRGB codes as stored. Mip levels are averaged in linear light here, not by the driver: the result
///          is equal on every driver, and coarse levels do not need the finest one.
/// Threads  pure; any: all of the work is done here; the upload only copies.
/// Errors   none.
#pragma once

#include "app/image/image.h"
#include "app/pack/pack.h"
#include "app/relief/block_relief.h"
#include "app/scene/scene_level.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace frustumscreen::scene {

struct LevelData {
    std::vector<pack::PackVertex> vertices;
    std::vector<image::Image8> mips; ///< finest first; only the levels to upload
    /// An earlier one of the levels that are uploaded one after another, whose texture is this one's too; then there are no `mips`.
    std::optional<std::size_t> texture_of{};
    int finest_mip = 0; ///< level of the whole texture that `mips` begins with
    double texels_per_box = 0.0;
    bool cut_out = false;
    /// Replaces all of the above: a relief, which stays in main memory.
    std::shared_ptr<const relief::BlockRelief> relief{};
    bool on_gpu = false; ///< the GPU draws the relief, so it goes into the GPU's memory too
};
/// `texture`: the level's whole texture.
[[nodiscard]] LevelData level_data(const SceneLevel& level, const image::Image8& texture);
/// Without mip levels.
[[nodiscard]] LevelData mesh_data(const SceneLevel& level);

} // namespace frustumscreen::scene
