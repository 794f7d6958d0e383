/// The errors that are seen of a region of a site, without what shows from under the ground (site_curtains.h).
///
/// Threads  as seen_errors (level.h).
#pragma once

#include "app/pack/seen_errors.h"
#include "assets_baked/bake/source_scene.h"
#include "assets_baked/bake/visibility.h"

namespace frustumscreen::bake {

/// As seen_errors, of the levels; a ray that meets `curtains` before the surface counts for neither.
[[nodiscard]] pack::SeenErrors seen_region_errors(const pack::Pack& pack, const SourceScene& source,
                                                  const SourceScene& curtains, const ViewingZone& zone,
                                                  double share);

} // namespace frustumscreen::bake
