/// A site of 36 regions, each with rings at two levels and its own colour.
///
/// Threads  pure; any.
#pragma once

#include "app/pack/pack_site.h"
#include "app/pack/pack_world.h"
#include "tests/show/shown_packs.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace frustumscreen::synthetic {

inline constexpr int site_rows = 6;
inline constexpr std::size_t site_regions = 36;

/// The blue of a region's colour, which tells its number.
inline std::uint8_t region_blue(std::size_t number) {
    return static_cast<std::uint8_t>(7 * number);
}

/// Has two levels: the coarse one is good enough in the miniature, and not at six times its size. Its texture is as large as the site's, so
/// six times as fine.
inline pack::Pack region_pack(std::size_t number) {
    pack::Pack pack = numbered_pack(0);
    pack.textures[0] = image::Image8(64, 64, {250, 250, region_blue(number), 255});
    pack.levels[0].error = {4e-3F, 8e-3F, 2e-2F, 0.0F};
    return pack;
}

/// Regions of equal size on the squares of a ground.
inline pack::Pack site_pack() {
    pack::Pack whole = numbered_pack(0);
    pack::PackWorld world;
    pack::PackSite site{.max_triangles = 2000, .places = {}};
    std::vector<pack::Pack> geometry;
    for (std::size_t k = 0; k < site_regions; ++k) {
        geometry.push_back(region_pack(k));
        const glm::dvec3 size = whole.box_size / static_cast<double>(site_rows);
        const glm::dvec3 middle(size.x * (static_cast<double>(k % site_rows) - 2.5),
                                size.y * (static_cast<double>(k / site_rows) - 2.5), 0.0);
        pack::PackCell& cell = world.cells.emplace_back();
        cell.cell.name = fmt::format("region {}", k + 1);
        cell.cell.has_geometry = true;
        cell.cell.parent_from_base =
            glm::scale(glm::translate(glm::dmat4(1.0), middle), glm::dvec3(1.0 / site_rows));
        cell.triangles = 1728;
        cell.low = middle - glm::dvec3(0.5 * size.x, 0.5 * size.y, 0.0);
        cell.high = middle + glm::dvec3(0.5 * size.x, 0.5 * size.y, size.z);
        site.places.push_back(middle);
    }
    const Result<void> put = pack::put_world(whole, world, geometry);
    EXPECT_TRUE(put) << put.error().message;
    pack::put_site(site, whole);
    return whole;
}

} // namespace frustumscreen::synthetic
