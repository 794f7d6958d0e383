/// A made-up site (app/simulation/site.h) as a mesh to bake or to write.
///
/// Frame    the site's own metres, z up (`default_up`). The colours have their light in them: it is unlit.
/// Threads  pure; any.
/// Errors   none.
#pragma once

#include "app/simulation/site.h"
#include "assets_baked/bake/source_mesh.h"

namespace frustumscreen::artifacts {

[[nodiscard]] bake::SourceMesh mesh_of_site(const simulation::Site& site);

} // namespace frustumscreen::artifacts
