// Made-up sites: their numbers, their frame, and that their surfaces are seen from their fronts.

#include "app/simulation/site.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace frustumscreen::simulation {
namespace {

struct Extent {
    glm::vec3 low{1e9F}, high{-1e9F};
};
Extent extent_of(const Site& site) {
    Extent extent;
    for (const glm::vec3& at : site.positions) {
        extent.low = glm::min(extent.low, at);
        extent.high = glm::max(extent.high, at);
    }
    return extent;
}

TEST(Site, HasExactlyTheRequestedTriangles) {
    for (const SiteKind kind : {SiteKind::HillTown, SiteKind::Excavation}) {
        for (const std::size_t triangles : {std::size_t{60'000}, std::size_t{126'791}}) { // even and odd
            const Site site = make_site({.kind = kind, .triangles = triangles});
            EXPECT_EQ(site.indices.size(), 3 * triangles);
            EXPECT_EQ(site.texture_places.size(), site.positions.size());
            EXPECT_LT(*std::max_element(site.indices.begin(), site.indices.end()), site.positions.size());
        }
    }
    EXPECT_EQ(make_site({.triangles = 5}).indices.size(), 3 * min_site_triangles);
}

TEST(Site, IsCentredOnItsGroundAtItsSize) {
    for (const SiteKind kind : {SiteKind::HillTown, SiteKind::Excavation}) {
        const Extent extent = extent_of(make_site({.kind = kind, .triangles = 60'000, .size_m = 0.3}));
        EXPECT_NEAR(extent.high.x - extent.low.x, 0.3F, 1e-6F); // wider than high
        EXPECT_NEAR(extent.high.x + extent.low.x, 0.0F, 1e-6F);
        EXPECT_NEAR(extent.high.y + extent.low.y, 0.0F, 1e-6F);
        EXPECT_EQ(extent.low.z, 0.0F);
        EXPECT_GT(extent.high.z, 0.03F);
    }
}

TEST(Site, DependsOnlyOnItsSeed) {
    const Site site = make_site({.triangles = 60'000, .seed = 5});
    EXPECT_EQ(site.positions, make_site({.triangles = 60'000, .seed = 5}).positions);
    EXPECT_NE(site.positions, make_site({.triangles = 60'000, .seed = 6}).positions);
}

/// The box of a site does not depend on its number of triangles: the same things are built.
TEST(Site, HasTheSameExtentForAnyNumberOfTriangles) {
    const Extent coarse = extent_of(make_site({.triangles = 60'000}));
    const Extent fine = extent_of(make_site({.triangles = 200'000}));
    EXPECT_LT(glm::distance(coarse.low, fine.low), 1e-3F);
    EXPECT_LT(glm::distance(coarse.high, fine.high), 1e-3F);
}

/// From above, the nearest surface of each place is met from its front: a heightmap of the triangles' highest points, each of
/// which must not be of a triangle that looks down.
TEST(Site, ShowsFrontFacesFromAbove) {
    for (const SiteKind kind : {SiteKind::HillTown, SiteKind::Excavation}) {
        const Site site = make_site({.kind = kind, .triangles = 120'000});
        constexpr int cells = 300;
        struct Top {
            float z = -1.0F;
            bool from_behind = false;
        };
        std::vector<Top> tops(static_cast<std::size_t>(cells) * cells);
        const auto cell_of = [](float at) { return (at / 0.15F + 0.5F) * cells; };
        for (std::size_t k = 0; k + 2 < site.indices.size(); k += 3) {
            const glm::vec3 a = site.positions[site.indices[k]];
            const glm::vec3 b = site.positions[site.indices[k + 1]];
            const glm::vec3 c = site.positions[site.indices[k + 2]];
            const float area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
            if (area == 0.0F) {
                continue;
            }
            const auto [low_x, high_x] = std::minmax({a.x, b.x, c.x});
            const auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
            const int last_x = std::min(cells - 1, static_cast<int>(cell_of(high_x)));
            const int last_y = std::min(cells - 1, static_cast<int>(cell_of(high_y)));
            for (int y = std::max(0, static_cast<int>(cell_of(low_y))); y <= last_y; ++y) {
                for (int x = std::max(0, static_cast<int>(cell_of(low_x))); x <= last_x; ++x) {
                    const glm::vec2 at =
                        (glm::vec2(x, y) + 0.5F) / static_cast<float>(cells) * 0.15F - 0.075F;
                    const float u = ((at.x - a.x) * (c.y - a.y) - (c.x - a.x) * (at.y - a.y)) / area;
                    const float v = ((b.x - a.x) * (at.y - a.y) - (at.x - a.x) * (b.y - a.y)) / area;
                    if (u < 0.0F || v < 0.0F || u + v > 1.0F) {
                        continue;
                    }
                    Top& top = tops[static_cast<std::size_t>(y) * cells + static_cast<std::size_t>(x)];
                    const float z = a.z + u * (b.z - a.z) + v * (c.z - a.z);
                    if (z > top.z) {
                        top = {z, area < 0.0F};
                    }
                }
            }
        }
        const auto behind =
            std::count_if(tops.begin(), tops.end(), [](const Top& top) { return top.from_behind; });
        const auto missing =
            std::count_if(tops.begin(), tops.end(), [](const Top& top) { return top.z < 0.0F; });
        EXPECT_EQ(missing, 0);
        EXPECT_LE(behind, 5); // where two surfaces meet in an edge, floats decide
    }
}

/// Each vertex has a place inside one row of the texture, far enough from the next that mip levels do not mix them.
TEST(Site, PlacesTextureCoordinatesInTheMiddleOfRows) {
    const Site site = make_site({.triangles = 60'000});
    std::set<float> rows;
    for (const glm::vec2& place : site.texture_places) {
        EXPECT_GE(place.x, 0.0F);
        EXPECT_LE(place.x, 1.0F);
        rows.insert(place.y * 16.0F - std::floor(place.y * 16.0F));
    }
    EXPECT_EQ(rows, std::set<float>{0.5F});
}

} // namespace
} // namespace frustumscreen::simulation
