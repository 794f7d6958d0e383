/// Wavefront OBJ with its .mtl: polygons of any size, negative indices, colours written after the
/// coordinates, base colour (Kd) and its picture (map_Kd). Points, lines and free-form curves are left out.
///
/// Frame    the file's; up is y. v is turned over: 0 at the picture's top row.
/// Colour   Kd is taken as linear, as today's writers mean it; vertex colours are sRGB in 0..1.
/// Errors   throws Refusal naming the line. Without its .mtl the model is white, which is noted; a missing
///          picture is refused.
/// Library  the .mtl is read by tinyobjloader. Geometry is read here: the library takes an unreadable number
///          for 0, cuts polygons at 255 corners, drops colours with callbacks, and does not say in which line
///          it failed.
#pragma once

#include "assets_baked/bake/loaders/bytes.h"
#include "assets_baked/bake/loaders/model_files.h"

namespace frustumscreen {

[[nodiscard]] SourceMesh load_obj(ByteView file, ModelFiles& files);

} // namespace frustumscreen
