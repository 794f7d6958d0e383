#include "firmware_host/display/shader_cache.h"

#include "firmware_host/base/descriptor.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace frustumscreen::display {

namespace {

/// 65536 keys of 20 bytes, and the size of the whole cache. A Mesa version with another index makes its own
/// file, without allocated blocks.
constexpr off_t index_bytes = 8 + 65536 * 20;

/// Returns 0 or the error number.
int set_aside(const std::filesystem::path& folder) {
    std::error_code failed; // `open` reports the error
    std::filesystem::create_directories(folder, failed);
    const Descriptor index(::open((folder / "index").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
    return index.number() < 0 ? errno : ::posix_fallocate(index.number(), 0, index_bytes);
}

} // namespace

Result<void> keep_shaders_in(const std::filesystem::path& folder) {
    if (const int why = set_aside(folder / "mesa_shader_cache"); why != 0) {
        keep_no_shaders();
        return bad_input("display.shader_cache",
                         "{}: compiled shaders cannot be kept there: {}; each start takes longer",
                         folder.string(), std::strerror(why));
    }
    ::setenv("MESA_SHADER_CACHE_DIR", folder.c_str(), 1);
    ::setenv("MESA_SHADER_CACHE_MAX_SIZE", "64M", 1);
    return {};
}

void keep_no_shaders() {
    ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
}

} // namespace frustumscreen::display
