/// Contents of a glTF file that the exhibit does not show: normal maps, occlusion maps, emission, morph targets, vertex
/// attributes. Lost movements are told where the others are kept (gltf_world.h).
///
/// Counts   materials of the parts that are drawn; morph targets of the whole file.
/// Told     an attribute that is not read counts as lost only if it could change the picture: joints and weights of a
///          skin, and any other of three or four numbers, which may be a colour (COLOR_1, _TINT). TEXCOORD and TANGENT
///          serve maps, which are told themselves; fewer numbers (_FEATURE_ID_0) are no colour.
/// Threads  values; any.
#pragma once

#include "assets_baked/bake/loaders/gltf_model.h"
#include "assets_baked/bake/loaders/load_notes.h"

#include <cstddef>
#include <set>
#include <string>

namespace frustumscreen::bake {

/// Adds the names of the attributes of a drawn primitive that are not read and could change the picture.
void add_lost_attributes(const GltfModel& model, const GltfPrimitive& primitive, bool has_skin,
                         std::set<std::string>& names);
void note_lost_attributes(const std::set<std::string>& names, LoadNotes& notes);
void note_gltf_losses(const GltfModel& model, const std::set<std::size_t>& drawn_materials, LoadNotes& notes);

} // namespace frustumscreen::bake
