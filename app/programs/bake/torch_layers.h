/// The layers of an artifact's torch and states, as a look of the scan's surface: a picture in place of the scan's own, or a
/// model of the same surface with other pictures.
///
/// Errors   one line that begins with the place in artifact.toml: another surface, a picture of another shape, a scan
///          whose pictures one picture cannot replace.
/// Threads  pure apart from reading the files; any.
#pragma once

#include "app/programs/bake/bake_request.h"
#include "assets_baked/bake/source_mesh.h"
#include "firmware_host/base/result.h"

#include <cstddef>

namespace frustumscreen::programs {

/// Adds the request's layers to a scan as it was read, each once.
[[nodiscard]] Result<void> add_layers(const BakeRequest& request, bake::SourceMesh& mesh);
/// The layer that a torch's stage shows, in the order of SourceMesh::layers.
[[nodiscard]] std::size_t layer_of(const BakeRequest& request, const folder::ArtifactTorchStage& stage);
/// The layer of a state, which covers the whole surface, in the same order.
[[nodiscard]] std::size_t state_layer_of(const BakeRequest& request, const folder::ArtifactTorchStage& stage);

} // namespace frustumscreen::programs
