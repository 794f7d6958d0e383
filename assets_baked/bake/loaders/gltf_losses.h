/// Contents of a glTF file that the exhibit does not show: normal maps, occlusion maps, emission, movement.
/// Counts   materials of the drawn primitives; animations and morph targets of the whole file.
/// Counts   materials of the parts that are drawn; animations and morph targets of the whole file.
/// Threads  values; any.
#pragma once

#include "assets_baked/bake/loaders/gltf_model.h"
#include "assets_baked/bake/loaders/load_notes.h"

#include <cstddef>
#include <set>

namespace frustumscreen::bake {

void note_gltf_losses(const GltfModel& model, const std::set<std::size_t>& drawn_materials, LoadNotes& notes);

} // namespace frustumscreen::bake
