/// Memory that the driver has allocated for an object: sizes and bits are queried from the driver instead of
/// computed from the request.
///
/// Units    bytes; a driver's overhead (alignment, tiling) is not included.
/// Threads  the render thread.
#pragma once

#include "firmware_host/gl/gl_handle.h"

#include <cstdint>
#include <string>

namespace frustumscreen::render {

[[nodiscard]] std::uint64_t bytes_of_buffer(const gl::GlBuffer& buffer);
/// Two-dimensional, all mip levels.
[[nodiscard]] std::uint64_t bytes_of_texture(const gl::GlTexture& texture);
/// The driver's name of the GPU.
[[nodiscard]] std::string renderer_name();

[[nodiscard]] std::uint64_t bytes_of_renderbuffer(const gl::GlRenderbuffer& renderbuffer);

} // namespace frustumscreen::render
