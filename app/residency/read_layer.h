/// A layer of an artifact, read from its pack: other textures of the same surface.
///
/// Threads  a value.
#pragma once

#include "app/image/image.h"

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
};

} // namespace frustumscreen::residency
