/// From the polygons of a file to the solid that a prop is: closed, convex, with 4 to 16 flat faces.
///
/// Frame    that of the polygons. Metres.
/// Errors   one sentence: which face, edge or line, by how much, what is allowed, what to do.
/// Threads  pure; any.
#pragma once

#include "app/solid/polygon_mesh.h"
#include "app/solid/solid.h"
#include "firmware_host/base/result.h"

#include <string>
#include <vector>

namespace frustumscreen::solid {

struct MadeSolid {
    /// A face has the name of its group if no other face has polygons of that group; else F1, F2, ..., by its
    /// place in the file.
    Solid solid;
    std::vector<std::string> notes; ///< what was changed
};

[[nodiscard]] Result<MadeSolid> make_solid(PolygonMesh mesh);

} // namespace frustumscreen::solid
