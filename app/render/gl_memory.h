/// How much memory the driver gave an object, as the driver says: sizes and bits are queried, not computed
/// from what was asked for.
///
/// Units    bytes; what a driver adds for its own purposes (alignment, tiling) is not in it.
/// Threads  the render thread.
#pragma once

#include "firmware_host/gl/gl_handle.h"

#include <cstdint>
#include <string>

namespace frustumscreen {

[[nodiscard]] std::uint64_t bytes_of_buffer(const GlBuffer& buffer);
/// Two-dimensional, all mip levels.
[[nodiscard]] std::uint64_t bytes_of_texture(const GlTexture& texture);
/// What the driver calls the GPU.
[[nodiscard]] std::string renderer_name();

[[nodiscard]] std::uint64_t bytes_of_renderbuffer(const GlRenderbuffer& renderbuffer);

} // namespace frustumscreen
