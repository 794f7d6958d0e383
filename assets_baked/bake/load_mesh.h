/// Reads any artifact file: glTF 2.0 (.gltf, .glb), OBJ, PLY, STL.
///
/// Errors   one line for the curator: file, problem, remedy; details in brackets. Never crashes on malicious
///          bytes; memory is bounded by the file's own size and the counts that it backs with data; OBJ, PLY and
///          STL never lie in memory whole beside their mesh. Anything
///          merely lost (a colour, an invisible face) is a note of the mesh.
/// Threads  pure apart from reading `path` and the files that it names; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <filesystem>
#include <functional>

namespace frustumscreen {

struct LoadOptions {
    /// A picture to use if the model names a missing one or none at all; empty: none.
    std::filesystem::path texture;
    /// All pictures together are shrunk to this number of texels, which keep 1 GiB of memory; bake.h says how many a
    /// pack can use.
    std::int64_t kept_texels = std::int64_t{1} << 28;
    /// Called with the share of the file that is read, 0..1, by the formats that are read from their beginning.
    std::function<void(double done)> progress = [](double) {};
};

/// A loaded mesh has at least one triangle, every index in range and every position finite.
[[nodiscard]] Result<SourceMesh> load_mesh(const std::filesystem::path& path,
                                           const LoadOptions& options = {});

} // namespace frustumscreen
