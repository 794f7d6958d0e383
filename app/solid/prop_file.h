/// A prop file: the shape of a prop as a plain OBJ.
///
/// Frame    the file's: the prop stands on z = 0 and +Z is up, unless the settings turn it. In memory metres.
/// Errors   one sentence with the face, the edge or the line: what is wrong, by how much, what is allowed.
/// Threads  pure; any.
#pragma once

#include "app/solid/obj_text.h"
#include "app/solid/solid.h"
#include "firmware_host/base/result.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::solid {

struct PropFile {
    Solid solid; ///< faces are named by their groups (`g`, `o`), else F1, F2, ... in the order of the file
    std::vector<std::string> notes; ///< one line each: what is left out, what was changed
};

[[nodiscard]] Result<PropFile> parse_prop_file(std::string_view text, LengthUnit unit);

/// The first line of what `write_prop_file` writes.
inline constexpr std::string_view prop_file_heading =
    "# The shape of a prop: millimetres, +Z up; it stands on z = 0.\n";
/// In millimetres, with a group for each face.
[[nodiscard]] std::string write_prop_file(const Solid& solid);

/// Fails unless, for a prop in its own frame, the lowest corner lies on z = 0 and the axis x = y = 0 runs through the
/// prop.
[[nodiscard]] Result<void> check_stand(const Solid& solid);
/// Fails unless one of the faces lies on z = 0.
[[nodiscard]] Result<void> check_foot(const Solid& solid);
/// A prop file that passes both checks.
[[nodiscard]] Result<PropFile> parse_standing_prop(std::string_view text, LengthUnit unit);

/// The mean distance between an adult's eyes.
/// Source   Dodgson, Variation and extrema of human interpupillary distance, 2004: mean 63 mm, nearly all within
///          50 to 75 mm.
inline constexpr double eyes_apart_m = 0.063;

/// A sentence for who makes a prop narrower than a person's eyes are apart, of whose faces the two eyes
/// together may see more than one eye can; nullopt if it is wide enough.
/// Source   Kim, Shin, Kim, Using relief texture for interactive and tangible virtual environments, 2008.
[[nodiscard]] std::optional<std::string> narrowness(const Solid& solid, double eyes_m = eyes_apart_m);

} // namespace frustumscreen::solid
