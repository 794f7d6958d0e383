/// Reads polygons from a plain Wavefront OBJ: lines `v`, `f`, `g` and `o`, comments, lines that go on after a
/// backslash. Corners are written v, v/vt, v//vn or v/vt/vn; a negative number counts back from the latest
/// vertex. Every other keyword is left out and told once.
///
/// Frame    the file's; lengths are converted to metres.
/// Errors   one sentence with the line; nothing is guessed.
/// Threads  pure; any.
/// Source   Wavefront, Object Files (.obj), Appendix B1 of the Advanced Visualizer's manual.
#pragma once

#include "app/solid/polygon_mesh.h"
#include "firmware_host/base/result.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::solid {

inline constexpr std::size_t max_obj_bytes = std::size_t{1} << 20U;

struct ObjText {
    PolygonMesh mesh; ///< a polygon's name is its group's, printable, cut to 40 bytes
    std::vector<std::string> notes;
};

[[nodiscard]] Result<ObjText> parse_obj(std::string_view text, LengthUnit unit);

} // namespace frustumscreen::solid
