/// Fills in the nodes of a SourceMesh, the node of each triangle, and the animations that move them.
///
/// Kept     translation, rotation and scale of nodes with triangles at or below them, within the limits of a world
///          (behaviour.h).
/// Told     what is not kept, with the animation's name: movements of a skin's joints, of morph weights, of what has
///          no triangles; animations beyond the limits.
/// Errors   throws Refusal: what gltf_curve.h refuses; two channels of an animation that move the same; an animated node
///          with a matrix.
#pragma once

#include "assets_baked/bake/loaders/gltf_buffers.h"
#include "assets_baked/bake/loaders/gltf_tree.h"
#include "assets_baked/bake/loaders/load_notes.h"
#include "assets_baked/bake/source_mesh.h"

#include <span>

namespace frustumscreen::bake {

/// A node that was drawn: its triangles are those from the end of the one before it.
struct DrawnNode {
    std::size_t node = 0;
    std::size_t end = 0; ///< number of the mesh's triangles after it
};

void add_gltf_world(const GltfModel& model, const GltfTree& tree, GltfBuffers& buffers,
                    std::span<const DrawnNode> drawn, SourceMesh& mesh, LoadNotes& notes);

} // namespace frustumscreen::bake
