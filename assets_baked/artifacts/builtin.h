/// The built-in artifacts, so that a new machine has something to show.
///
/// Frame    glTF-like: +Y up, millimetres. Deterministic: equal name and count give equal meshes.
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace frustumscreen::artifacts {

/// "amphora", ...: those of the exhibit, with texts.
[[nodiscard]] std::vector<std::string_view> builtin_names();

/// One of these, or of the example hall's (hall/hall.h). About `triangles` triangles (within 5 %). Errors: unknown name,
/// fewer than 1000 or more than 5e7 triangles.
[[nodiscard]] Result<bake::SourceMesh> make_builtin(std::string_view name, std::int64_t triangles);

/// A picture that the folder of a built-in artifact has beside the mesh: a layer for the torch.
struct BuiltinLayer {
    std::string_view file;
    image::Image8 picture;
};
/// Those that builtin_folder_text names.
[[nodiscard]] std::vector<BuiltinLayer> builtin_layers(std::string_view name);

/// The artifact.toml of a folder with a built-in artifact's mesh (docs/curators.md): texts in five languages,
/// hotspots, what a torch shows. Empty for an unknown name and for the hall's.
[[nodiscard]] std::string_view builtin_folder_text(std::string_view name);

} // namespace frustumscreen::artifacts
