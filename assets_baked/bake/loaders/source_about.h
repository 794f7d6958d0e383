/// What a model's file says of itself: title, author, licence, source.
///
/// glTF     `asset.extras` as Sketchfab's downloads have it (title, author, license, source), and `asset.copyright`.
/// OBJ, PLY comments such as `# License: CC-BY-4.0`, also of the file of materials. The first one of a kind counts.
/// Text     one line each, without control characters; as the file has it otherwise.
/// Errors   none: what is no text is passed over.
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"
#include "firmware_host/base/json.h"

#include <string_view>

namespace frustumscreen {

[[nodiscard]] SourceAbout about_of_gltf(const nlohmann::json& document);

/// `comment`: a line, without the sign that makes it one.
void take_comment(std::string_view comment, SourceAbout& about);
/// Of each line that begins with #.
void take_comments(std::string_view text, SourceAbout& about);

} // namespace frustumscreen
