/// The view of `frustumscreen render --site`: the part of a site around a place of its ground.
///
/// Ground   the region's own (pack_site.h). On a steep slope it is raised, so that the site's surface at the place is not above the prop's
///          middle: the prop would then be inside the hill.
/// Frame    box of the whole site.
/// Threads  any.
/// Errors   a pack that is no site, a place beside it; as load_cell.
#pragma once

#include "app/pack/pack.h"
#include "app/scene/scene_plan.h"
#include "app/show/offline_scene.h"
#include "app/world/site_view.h"
#include "firmware_host/base/result.h"

#include <filesystem>

namespace frustumscreen::show {

/// `pack`: of the file; `whole`: its plan.
[[nodiscard]] Result<world::SiteView> offline_site_view(const std::filesystem::path& file,
                                                        const pack::PackDescription& pack,
                                                        const scene::ScenePlan& whole,
                                                        const OfflineSite& site);

} // namespace frustumscreen::show
