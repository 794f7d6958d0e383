#include "firmware_host/display/plain_drawing.h"

#include "firmware_host/display/shader_cache.h"

#include <array>
#include <cstdlib>
#include <utility>

namespace frustumscreen::display {

namespace {

constexpr std::array<std::pair<const char*, const char*>, 5> plain{{
    {"LIBGL_ALWAYS_SOFTWARE", "1"},
    {"GBM_ALWAYS_SOFTWARE", "1"},
    {"LP_NUM_THREADS", "0"},
    {"LP_NATIVE_VECTOR_WIDTH", "128"},
    {"GALLIUM_OVERRIDE_CPU_CAPS", "sse4.1"},
}};

} // namespace

void draw_plainly() {
    for (const auto& [name, value] : plain) {
        ::setenv(name, value, 1);
    }
    keep_no_shaders();
}

} // namespace frustumscreen::display
