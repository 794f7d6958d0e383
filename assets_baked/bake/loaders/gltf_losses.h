/// What a glTF file has and the exhibit does not show: maps of normals and of occlusion, light of its own, movement.
///
/// Counts   materials of the parts that are drawn; animations and morph targets of the whole file.
/// Threads  values; any.
#pragma once

#include "assets_baked/bake/loaders/gltf_model.h"
#include "assets_baked/bake/loaders/load_notes.h"

#include <cstddef>
#include <set>

namespace frustumscreen {

void note_gltf_losses(const GltfModel& model, const std::set<std::size_t>& drawn_materials, LoadNotes& notes);

} // namespace frustumscreen
