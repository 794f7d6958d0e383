/// Writes a SourceMesh as one binary glTF file, so that other programs can compare the exhibit's pictures with the
/// mesh.
///
/// Frame    the mesh's own coordinates, as 32-bit floats; textures embedded as PNG.
/// Errors   a file of 4 GiB or more, which the format cannot hold.
/// Threads  pure; any.
/// Source   Khronos glTF 2.0 specification, chapters 3 and 4.
#pragma once

#include "assets_baked/bake/source_mesh.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

namespace frustumscreen::artifacts {

[[nodiscard]] Result<Bytes> write_glb(const bake::SourceMesh& mesh);

} // namespace frustumscreen::artifacts
