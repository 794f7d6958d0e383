/// The metadata of a model's file: title, author, licence, source.
///
/// glTF     `asset.extras` as in Sketchfab's downloads (title, author, license, source), and `asset.copyright`.
/// OBJ, PLY comments such as `# License: CC-BY-4.0`, also of the .mtl file. The first comment of each kind counts.
/// Text     one line each, without control characters; otherwise as in the file.
/// Errors   none: values that are not text are skipped.
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"
#include "firmware_host/base/json.h"

#include <string_view>

namespace frustumscreen::bake {

[[nodiscard]] SourceAbout about_of_gltf(const nlohmann::json& document);

/// `comment`: a line without its comment sign.
void take_comment(std::string_view comment, SourceAbout& about);
/// Takes each line that begins with #.
void take_comments(std::string_view text, SourceAbout& about);

} // namespace frustumscreen::bake
