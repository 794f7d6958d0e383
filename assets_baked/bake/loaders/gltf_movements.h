/// Reads the animations of a glTF file that move triangles, and tells what is lost of the others.
///
/// Errors   throws Refusal, as gltf_world.h says.
#pragma once

#include "assets_baked/bake/loaders/gltf_buffers.h"
#include "assets_baked/bake/loaders/gltf_cells.h"
#include "assets_baked/bake/loaders/load_notes.h"
#include "assets_baked/bake/source_mesh.h"

#include <vector>

namespace frustumscreen::bake {

/// `cell` of the channels is the file's node.
[[nodiscard]] std::vector<SourceAnimation> gltf_movements(const GltfModel& model, const GltfTree& tree,
                                                          GltfBuffers& buffers,
                                                          const std::vector<GltfDraws>& draws,
                                                          LoadNotes& notes);

} // namespace frustumscreen::bake
