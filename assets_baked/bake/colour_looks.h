/// Looks for likely mistakes in a mesh's colours (last_look.h): each is a sentence that says what and what to do, or nothing.
///
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <optional>
#include <string>

namespace frustumscreen::bake {

[[nodiscard]] std::optional<std::string> look_for_black(const SourceMesh& mesh);
/// A mesh without pictures and colours at its vertices has one colour on purpose; a black one has a look of its own.
[[nodiscard]] std::optional<std::string> look_for_one_colour(const SourceMesh& mesh);
/// For a mesh that will be lit: colours that the file gives as light, or as unlit.
[[nodiscard]] std::optional<std::string> look_for_own_light(const SourceMesh& mesh);

} // namespace frustumscreen::bake
