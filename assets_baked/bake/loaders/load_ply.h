/// PLY: ASCII and both byte orders; vertices with optional colours, faces as lists of any whole type,
/// polygons cut into triangles, Stanford's triangle strips. Elements and properties with other names are
/// skipped.
///
/// Frame    the file's; up is y. Texture coordinates are flipped: 0 at the picture's top row.
/// Colour   red, green, blue (alpha): whole numbers are 8- or 16-bit sRGB codes, floats are sRGB in 0..1.
///          Comments "TextureFile NAME" name the pictures. Texture coordinates are those of the vertices (s, t or
///          u, v or texture_u, texture_v) or, as in MeshLab's files, of the faces' corners (a list texcoord of two
///          numbers a corner, with the picture's number as texnumber). A picture has precedence over vertex colours.
/// Errors   throws Refusal.
#pragma once

#include "assets_baked/bake/loaders/bytes.h"
#include "assets_baked/bake/loaders/model_files.h"

namespace frustumscreen::bake {

[[nodiscard]] SourceMesh load_ply(ByteView file, ModelFiles& files);

} // namespace frustumscreen::bake
