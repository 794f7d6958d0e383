/// Reads any artifact file: glTF 2.0 (.gltf, .glb), OBJ, PLY, STL.
///
/// Errors   one line for the curator: file, what is the matter, what to do; details in brackets. Never crashes
///          on hostile bytes; memory is bounded by the file's own size and the counts it can back with data.
///          What is only lost (a colour, a face that shows nothing) is a note of the mesh.
/// Threads  pure apart from reading `path` and the files that it names; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"
#include "firmware_host/base/result.h"

#include <filesystem>

namespace frustumscreen {

struct LoadOptions {
    /// A picture for where the model names one that is not there, or names none at all; empty: none.
    std::filesystem::path texture;
};

/// A loaded mesh has at least one triangle, every index in range and every position finite.
[[nodiscard]] Result<SourceMesh> load_mesh(const std::filesystem::path& path,
                                           const LoadOptions& options = {});

} // namespace frustumscreen
