/// A layer of an artifact, read from its pack: other textures of the same surface, and of the cells' surfaces.
///
/// Threads  `add_layer`: the render thread, with the display's context current.
/// Errors   as GpuStore::add_layer.
#pragma once

#include "app/image/image.h"
#include "app/render/gpu_store.h"
#include "app/scene/drawable.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace frustumscreen::residency {

struct ReadLayer {
    std::size_t layer = 0;
    std::vector<image::Image8> textures;                                  ///< in the order of the pack's
    std::vector<std::shared_ptr<const std::vector<glm::u8vec4>>> reliefs; ///< in the order of the pack's
    std::vector<std::size_t> texture_of_level{};                          ///< by level of the pack
    std::vector<std::uint32_t> relief_texels{};                           ///< by relief of the pack
    std::vector<ReadLayer> cells{};                                       ///< by KnownWorld::drawn
};

/// Gives a level the layer's texture, or a relief its colours, if it has one and was not given it before.
/// `number`: as LevelUse::level.
[[nodiscard]] Result<void> add_layer(render::GpuStore& store, const ReadLayer& layer, std::uint32_t number,
                                     bool is_relief, scene::Drawable& drawable);

} // namespace frustumscreen::residency
