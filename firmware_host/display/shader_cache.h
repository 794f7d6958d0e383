/// Compiled shaders of the graphics driver (Mesa), kept from one start to the next to save compiling them
/// again.
///
/// Mesa maps its index file into memory without allocating its blocks, so a write to it on a full disk kills
/// the program. The blocks are therefore allocated first; if that fails, there is no cache.
///
/// Threads  `keep_shaders_in`, `keep_no_shaders`: call them while the process has one thread and no display;
///          Mesa reads the environment.
/// Source   Mesa 22.3, docs/envvars.rst and src/util/disk_cache_os.c.
#pragma once

#include "firmware_host/base/result.h"

#include <filesystem>

namespace frustumscreen::display {

/// Keeps the cache below `folder`, which is made if missing; 64 MB at most. Errors: the disk is full or not
/// writable; then no shaders are kept.
[[nodiscard]] Result<void> keep_shaders_in(const std::filesystem::path& folder);

void keep_no_shaders();

} // namespace frustumscreen::display
