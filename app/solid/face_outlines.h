/// The corners of joined faces, in their order.
///
/// Errors   one sentence that names the face.
/// Threads  pure; any.
#pragma once

#include "app/solid/closed_mesh.h"
#include "app/solid/join_faces.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <string>
#include <vector>

namespace frustumscreen::solid {

/// For each face its corners: numbers of vertices, counter-clockwise seen from outside, the lowest number
/// first. Vertices on an edge between two faces are left out, in both of them. `names`: of the faces, for
/// messages.
[[nodiscard]] Result<std::vector<std::vector<std::uint32_t>>>
face_outlines(const ClosedMesh& closed, const std::vector<JoinedFace>& faces,
              const std::vector<std::string>& names);

} // namespace frustumscreen::solid
