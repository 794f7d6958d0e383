/// PLY: ASCII and both byte orders; vertices with optional colours, faces as lists of any whole type,
/// polygons cut into triangles, Stanford's triangle strips. Elements and properties with other names are
/// skipped.
///
/// Frame    the file's; up is y.
/// Colour   red, green, blue (alpha): whole numbers are 8- or 16-bit sRGB codes, floats are sRGB in 0..1.
/// Errors   throws Refusal.
#pragma once

#include "assets_baked/bake/loaders/bytes.h"
#include "assets_baked/bake/source_mesh.h"

namespace frustumscreen {

[[nodiscard]] SourceMesh load_ply(ByteView file);

} // namespace frustumscreen
