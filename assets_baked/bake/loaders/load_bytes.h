/// load_mesh for bytes that are already in memory, so that tests and fuzzers need no file.
#pragma once

#include "assets_baked/bake/load_mesh.h"
#include "assets_baked/bake/loaders/bytes.h"
#include "firmware_host/base/result.h"

#include <filesystem>

namespace frustumscreen::bake {

/// `path` names the model in messages; its side files are read from the disk.
[[nodiscard]] Result<SourceMesh> load_mesh_bytes(ByteView file, const std::filesystem::path& path,
                                                 const LoadOptions& options = {});

} // namespace frustumscreen::bake
