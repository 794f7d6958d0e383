/// Wavefront OBJ with its .mtl: polygons of any size, negative indices, colours written after the
/// coordinates, base colour (Kd) and its picture (map_Kd). Points, lines and free-form curves are left out.
///
/// Numbers  after x y z that are not read are lost, if they could change the picture: a fourth other than 1 (a weight),
///          two, more than four, an alpha that is not opaque. The third number of a texture coordinate is a depth, which
///          a picture does not have: it is ignored.
/// Frame    the file's; up is y. v is flipped: 0 at the picture's top row.
/// Colour   of materials: obj_materials.h. Vertex colours are sRGB in 0..1, or in 0..255 if one of the file's is above
///          1.
/// Errors   throws Refusal naming the line. Without its .mtl the model is white, which is noted; a missing
///          picture is refused.
/// Library  geometry is read here: tinyobjloader reads an invalid number as 0, cuts polygons at 255 corners, drops
///          colours with callbacks, and does not name the line of an error.
#pragma once

#include "assets_baked/bake/loaders/bytes.h"
#include "assets_baked/bake/loaders/model_files.h"

namespace frustumscreen::bake {

[[nodiscard]] SourceMesh load_obj(ByteView file, ModelFiles& files);

} // namespace frustumscreen::bake
