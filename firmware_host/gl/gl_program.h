/// Shader programs.
///
/// Threads  the render thread.
/// Errors   Internal: the driver refused one of our own shaders; with the first line of its log.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/gl/gl_handle.h"

#include <string_view>

namespace frustumscreen::gl {

/// Both stages get '#version 300 es', highp for all types (the lowp samplers that ES defaults to change
/// results) and `defines`.
[[nodiscard]] Result<GlProgram> make_program(std::string_view defines, std::string_view vertex,
                                             std::string_view fragment);

} // namespace frustumscreen::gl
