/// STL, binary and ASCII. A binary file may also begin with "solid", so its length decides.
///
/// Frame    the file's; up is z.
/// Errors   throws Refusal: truncated, a facet without three vertices. Normals and colour bits are ignored.
#pragma once

#include "assets_baked/bake/loaders/bytes.h"
#include "assets_baked/bake/loaders/model_files.h"

namespace frustumscreen {

/// True if the length is 84 bytes plus 50 for each triangle that the header declares.
[[nodiscard]] bool has_length_of_binary_stl(ByteView file);
[[nodiscard]] SourceMesh load_stl(ByteView file, ModelFiles& files);

} // namespace frustumscreen
