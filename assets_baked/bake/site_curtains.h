/// Hides what is seen only from under the ground: where a site was cut into regions, each region's underside is open.
///
/// Method   from each edge of a region that the cut made, a curtain hangs down past the region's lowest place, for the search of
///          what visitors see (visibility.h). It has none where the space right below it is open to the sky in the whole site, as
///          below a bridge.
/// Frame    box of the whole site, z up.
/// Threads  pure; any. Deterministic.
/// Errors   none.
#pragma once

#include "assets_baked/bake/source_mesh.h"
#include "assets_baked/bake/source_scene.h"

#include <array>
#include <vector>

namespace frustumscreen::bake {

using CurtainTriangle = std::array<glm::dvec3, 3>;

/// `region`, `whole`: in the box. `half_ground`: of the box, along x and y; its longer one is 0.5.
[[nodiscard]] std::vector<CurtainTriangle> site_curtains(const SourceMesh& region, const SourceScene& whole,
                                                         const glm::dvec2& half_ground);

} // namespace frustumscreen::bake
