/// Made-up sites as one triangle mesh each, at the size of a prop, as a museum shows them in miniature. The bench measures windows on them.
///
/// HillTown    terrain with a road, houses with windows and roofs, a church, a wall with towers, trees and fields.
/// Excavation  squares dug to terraces, with baulks between them, walls of stones, column drums, jars, and a heap of earth.
///
/// Frame    metres; up is +Z, the front looks along -Y; the middle of the site's ground is on the Z axis, its base at z = 0; the longest
///          edge of its box is `size_m`.
/// Colour   a place in `texture`: one row of shades for each material, so that no mip level mixes two; light from one side is in it.
/// Sides    triangles are counter-clockwise seen from outside; a pennant is one triangle that has no inside.
/// Detail   the same things stand in a site of any number of triangles: more of them only cut the surfaces finer.
/// Threads  pure; any. The same request gives the same site.
/// Errors   none; a number below `min_site_triangles` counts as that.
#pragma once

#include "app/image/image.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace frustumscreen::simulation {

enum class SiteKind : std::uint8_t { HillTown, Excavation };

inline constexpr std::size_t min_site_triangles = 42'000;
struct SiteRequest {
    SiteKind kind = SiteKind::HillTown;
    std::size_t triangles = 100'000; ///< exactly this number is made
    std::uint64_t seed = 1;
    double size_m = 0.15;
};

struct Site {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec2>
        texture_places; ///< one for each position; (0, 0) is the corner of the top left texel, (1, 1) the opposite one
    std::vector<std::uint32_t> indices; ///< three a triangle
    std::shared_ptr<const image::Image8> texture;
};

[[nodiscard]] Site make_site(const SiteRequest& request);

} // namespace frustumscreen::simulation
