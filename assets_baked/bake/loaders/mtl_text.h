/// Rewrites a .mtl file's text so that tinyobjloader reads it as its exporters mean it.
///
/// Source   the material format of Wavefront's Advanced Visualizer, and the PBR keywords that exporters add.
/// Threads  pure; any.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace frustumscreen::bake {

struct MtlText {
    /// Keywords in the library's spelling; no byte order mark. Each material begins with a white Kd, and a single
    /// number is repeated for all three.
    std::string text;
    std::set<std::string> unknown; ///< keywords unknown to the format, as written
    std::set<std::string>
        lost; ///< keywords of the format that would change the picture and are not read, as written
    bool kd_in_codes = false; ///< a Kd is above 1, so the file's are in 0..255
};

[[nodiscard]] MtlText mtl_text_from(std::string_view file);

} // namespace frustumscreen::bake
