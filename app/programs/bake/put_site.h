/// Cuts a site into regions, bakes each, and puts them into the pack (site_regions.h, pack_site.h).
///
/// Errors   one line: no site, a region that cannot be baked, a world that a pack does not allow.
/// Threads  as bake.h.
#pragma once

#include "app/pack/pack_world.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/site_regions.h"
#include "assets_baked/bake/source_mesh.h"
#include "firmware_host/base/result.h"

#include <string>
#include <vector>

namespace frustumscreen::programs {

struct MadeSite {
    pack::PackWorld world;         ///< as the pack has it
    std::vector<std::string> told; ///< for the report, a line each: regions, triangles, errors
};

/// `mesh`: of the whole, which was baked into `pack` with `options`. Losses are added to `notes`.
[[nodiscard]] Result<MadeSite> put_site(pack::Pack& pack, const bake::SourceMesh& mesh,
                                        const bake::SiteOptions& site, const bake::BakeOptions& options,
                                        std::vector<bake::SourceNote>& notes);

/// Before the work: whether the mesh can be cut.
[[nodiscard]] Result<void> check_site(const bake::SourceMesh& mesh, const bake::SiteOptions& site,
                                      const bake::BakeOptions& options);

} // namespace frustumscreen::programs
