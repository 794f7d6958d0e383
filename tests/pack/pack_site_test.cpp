// The section `site`: written, read and refused.
#include "app/pack/pack_file.h"
#include "app/pack/pack_site.h"
#include "tests/base/told.h"
#include "tests/pack/samples.h"
#include "tests/pack/world_samples.h"

#include <gtest/gtest.h>

namespace frustumscreen::pack {
namespace {

/// Two regions, and a cell without geometry.
Pack two_regions() {
    Pack pack = samples::pack();
    PackWorld world;
    for (int k = 0; k < 3; ++k) {
        PackCell& cell = world.cells.emplace_back();
        cell.cell.name = "region " + std::to_string(k);
        if (k != 1) {
            cell.cell.has_geometry = true;
            cell.triangles = 100;
            cell.low = glm::dvec3(-0.5, -0.5, 0.0) * pack.box_size;
            cell.high = glm::dvec3(0.5, 0.5, 1.0) * pack.box_size;
        }
    }
    const std::vector<Pack> geometry{samples::small_cell_pack(), Pack(), samples::small_cell_pack()};
    const Result<void> put = put_world(pack, world, geometry);
    EXPECT_TRUE(put) << (put ? "" : put.error().message);
    return pack;
}

const std::vector<glm::dvec3> two_places{{0.0, 0.0, 0.125}, {0.125, -0.0625, 0.0}};

TEST(PackSite, RoundTrip) {
    Pack pack = two_regions();
    EXPECT_EQ(site_of(pack).value(), std::nullopt);
    EXPECT_TRUE(site_regions_of(pack).value().empty());
    put_site({.max_triangles = 150'000, .places = two_places}, pack);
    const auto back = verify_pack(*write_pack(pack));
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(site_of(**back).value(), (PackSite{.max_triangles = 150'000, .places = two_places}));
    const std::vector<SiteRegion> regions = site_regions_of(**back).value();
    ASSERT_EQ(regions.size(), 2U);
    EXPECT_EQ(regions[0].low.z, 0.125); // from its ground up
    EXPECT_EQ(regions[1].low.z, 0.0);
    EXPECT_EQ(regions[1].high, glm::dvec3(0.5, 0.5, 1.0) * pack.box_size);
}

TEST(PackSite, RejectsMalformedData) {
    const auto refusal = [](Pack pack, const std::string& data) {
        pack.sections.push_back({"site", data, {}});
        const auto regions = site_regions_of(pack);
        EXPECT_FALSE(regions) << data;
        return regions ? std::string() : test::told(regions.error());
    };
    const Pack pack = two_regions();
    EXPECT_NE(refusal(pack, R"({"max_triangles":0,"places":[[0,0,0],[0,0,0]]})").find("max_triangles is 0"),
              std::string::npos);
    EXPECT_NE(refusal(pack, R"({"max_triangles":9,"places":[[0,0,0]]})").find("1 places for 2 regions"),
              std::string::npos);
    EXPECT_NE(refusal(pack, R"({"max_triangles":9,"places":[[0,0,0],[0,0,9]]})")
                  .find("places[1] is not in its region"),
              std::string::npos);
    EXPECT_NE(refusal(pack, R"({"max_triangles":9})").find("sections.site.data.places"), std::string::npos);
    EXPECT_NE(refusal(pack, R"({"max_triangles":9,"places":[],"more":1})").find("sections.site.data.more"),
              std::string::npos);
    EXPECT_NE(refusal(samples::pack(), R"({"max_triangles":9,"places":[]})").find("no cell has geometry"),
              std::string::npos);
}

} // namespace
} // namespace frustumscreen::pack
