/// The section `site` of a pack (FORMAT.md): the artifact is a site, terrain and buildings, whose cells are regions of its ground.
/// A region can be shown large in the prop; then the cells are drawn, otherwise the whole.
///
/// Region   the box of a cell's geometry, box units (PackCell::low, high).
/// Errors   one line beginning with the field's place in the manifest.
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"
#include "app/pack/pack_world.h"
#include "firmware_host/base/result.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace frustumscreen::pack {

struct PackSite {
    std::uint64_t max_triangles = 0; ///< of a region, as the bake was told; 1 to 2^32 - 1
    /// The middle of each region's ground, as high as its lowest places that are seen from above.
    std::vector<glm::dvec3> places;

    [[nodiscard]] bool operator==(const PackSite&) const = default;
};

/// The pack must not have the section yet.
void put_site(const PackSite& site, PackDescription& pack);
/// None: the pack is no site.
[[nodiscard]] Result<std::optional<PackSite>> site_of(const PackDescription& pack);

/// A region's box from its ground up, box units. It leaves out surfaces that cannot be seen, such as the bottom of a model's base.
struct SiteRegion {
    glm::dvec3 low{0.0}, high{0.0};
};
/// The regions of the cells with geometry, in their order; empty: the pack is no site. A site without such cells,
/// whose cells move, or whose places are not in their regions, is an error.
[[nodiscard]] Result<std::vector<SiteRegion>> site_regions_of(const PackDescription& pack);

} // namespace frustumscreen::pack
