/// Reads any artifact file: glTF 2.0 (.gltf, .glb), OBJ, PLY, STL.
///
/// Errors   one line: file, place inside it, reason. Never crashes on hostile bytes; memory is bounded by the
///          file's own size and the counts it can back with data.
/// Threads  pure apart from reading `path` and the files that it names; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"
#include "firmware_host/base/result.h"

#include <filesystem>

namespace frustumscreen {

/// A loaded mesh has at least one triangle, every index in range and every position finite.
[[nodiscard]] Result<SourceMesh> load_mesh(const std::filesystem::path& path);

} // namespace frustumscreen
