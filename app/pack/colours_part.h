/// Other colours of a relief's corners, as the bytes of their part: a layer that a torch shows. FORMAT.md defines them.
///
/// Order    that of BlockRelief::colours; alpha is the layer's own opacity.
/// Errors   `decode_colours` takes outside bytes: one line, without the part's name (the caller knows it). The size is
///          checked before memory is allocated.
/// Threads  pure; any.
#pragma once

#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace frustumscreen::pack {

/// 81 colours a block.
[[nodiscard]] Bytes encode_colours(std::span<const glm::u8vec4> colours);
/// `corners`: of the relief, as many as its part must have.
[[nodiscard]] Result<std::vector<glm::u8vec4>> decode_colours(std::span<const std::byte> bytes,
                                                              std::size_t corners);

} // namespace frustumscreen::pack
