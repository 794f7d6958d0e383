/// STL, binary and ASCII. A binary file may begin with "solid" too: its length tells.
///
/// Frame    the file's; up is z.
/// Errors   throws Refusal: truncated, a facet without three vertices. Normals and colour bits are left out.
#pragma once

#include "assets_baked/bake/loaders/bytes.h"
#include "assets_baked/bake/loaders/load_notes.h"

namespace frustumscreen {

/// Exactly 84 bytes, and 50 for each triangle that they declare.
[[nodiscard]] bool has_length_of_binary_stl(ByteView file);
[[nodiscard]] SourceMesh load_stl(ByteView file, LoadNotes& notes);

} // namespace frustumscreen
