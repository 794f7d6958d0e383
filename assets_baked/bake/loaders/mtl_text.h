/// A .mtl file's text, rewritten so that tinyobjloader reads it as its writers mean it.
///
/// Source   the material format of Wavefront's Advanced Visualizer, and the PBR keywords that exporters add to it.
/// Threads  pure; any.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace frustumscreen {

struct MtlText {
    /// Keywords in the library's case; no byte order mark; each material begins with a white Kd, and a single number stands for all three.
    std::string text;
    std::set<std::string> unknown; ///< keywords that the format does not have, as written
    bool kd_in_codes = false;      ///< a Kd is above 1, so that those of the file are in 0..255
};

[[nodiscard]] MtlText mtl_text_from(std::string_view file);

} // namespace frustumscreen
