/// Where the graphics driver (Mesa) keeps compiled shaders from one start to the next, so that it compiles them once.
///
/// Mesa maps its index into memory without having set its blocks aside: on a full disk the program dies when it writes there. So
/// they are set aside before, or there is no cache.
///
/// Threads  `keep_shaders_in`, `keep_no_shaders`: while there is one thread and no display yet; Mesa reads the environment.
/// Source   Mesa 22.3, docs/envvars.rst and src/util/disk_cache_os.c.
#pragma once

#include "firmware_host/base/result.h"

#include <filesystem>

namespace frustumscreen {

/// Below `folder`, which is made if it is missing; 64 MB at most. Errors: the disk has no room, or cannot be written; then no
/// shaders are kept.
[[nodiscard]] Result<void> keep_shaders_in(const std::filesystem::path& folder);

void keep_no_shaders();

} // namespace frustumscreen
