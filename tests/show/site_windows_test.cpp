// Windows that show a part of a site, against rays to the regions' own triangles: a window that was pinned in a region has all regions
// that its eye sees, also those that no face of the prop showed, and the preview shows the marked region as it will stand in the prop.

#include "tests/render/counted_new.h"
#include "tests/render/keep_picture.h"
#include "tests/show/site_windows_rig.h"

#include <array>
#include <cstdio>
#include <set>
#include <string>

namespace frustumscreen::synthetic {
namespace {

TEST_F(SiteWindows, PinnedInARegionShowsAllThatItsEyeSees) {
    start(unlimited);
    const std::size_t region = 14;
    const world::SiteView part = view_at(region);
    for (int frame = 0; frame < 60; ++frame) {
        draw(part, std::nullopt);
    }
    const std::size_t in_prop = cells().parts().size(); // others show on no face
    const TestTable pinned_at = table_;
    const typography::TableRectangle rectangle{{0.19, 0.0}, {0.12, 0.12}, 0};
    pin(rectangle);
    draw(part, std::nullopt);
    const scene::PinnedView view = pinned(rectangle, pinned_at);
    const std::array<glm::dvec3, 3> eyes{table_.eye_m, {0.45, -0.25, 0.5}, {-0.1, 0.3, 0.55}};
    std::set<std::size_t> ever;
    for (std::size_t k = 0; k < eyes.size(); ++k) {
        table_.eye_m = eyes[k];
        for (int frame = 0; frame < 40; ++frame) { // the prop is back in miniature, and the window stays
            draw(k == 0 ? std::optional(part) : std::nullopt, std::nullopt);
        }
        const image::Image8 drawn = picture();
        keep_picture(drawn, "WINDOW_PICTURES", "site_window_" + std::to_string(k));
        const Counts counts = compare(drawn, view, part);
        std::printf("eye %zu: %zu show something of %zu regions, %zu nothing, %zu at an outline, %zu wrong\n",
                    k, counts.shown, counts.regions.size(), counts.empty, counts.outline, counts.wrong);
        EXPECT_GT(counts.shown, 1000U);
        EXPECT_EQ(counts.wrong, 0U);
        for (const std::size_t near : {7U, 8U, 9U, 13U, 14U, 15U, 19U, 20U, 21U}) {
            EXPECT_TRUE(fine_regions()[near]) << near;
        }
        EXPECT_LT(counts.outline, counts.shown / 50);
        ever.insert(counts.regions.begin(), counts.regions.end());
    }
    std::printf("the prop's faces showed %zu regions, the window %zu\n", in_prop, ever.size());
    EXPECT_GT(ever.size(), in_prop);
}

TEST_F(SiteWindows, ThePreviewShowsTheMarkedRegionAsItWillStandInTheProp) {
    start(unlimited);
    for (const std::size_t region : {std::size_t{0}, std::size_t{21}}) {
        const typography::TableRectangle rectangle{{-0.19, 0.02}, {0.08, 0.08}, 0};
        presentation_.site_map = exhibit::PresentedTitle{
            .title = {.artifact = 0, .behaviour = exhibit::site_preview_title + region, .language = 0},
            .rectangle = rectangle,
            .brightness = 1.0};
        for (int frame = 0; frame < 40; ++frame) {
            draw(std::nullopt, region);
        }
        const image::Image8 drawn = picture();
        keep_picture(drawn, "WINDOW_PICTURES", "site_preview_" + std::to_string(region));
        const Counts counts = compare(drawn, pinned(rectangle, table_), view_at(region));
        std::printf(
            "region %zu: %zu show something of %zu regions, %zu nothing, %zu at an outline, %zu wrong\n",
            region, counts.shown, counts.regions.size(), counts.empty, counts.outline, counts.wrong);
        EXPECT_TRUE(counts.regions.contains(region));
        EXPECT_GT(counts.shown, 500U);
        EXPECT_EQ(counts.wrong, 0U);
        EXPECT_TRUE(fine_regions()[region]);
        EXPECT_LT(counts.outline, counts.shown / 50);
    }
}

/// Where the memory holds ten pages, a window leaves its own to the prop.
TEST_F(SiteWindows, YieldTheirMemoryToTheProp) {
    start(unlimited);
    stay(14);
    const std::array<bool, site_regions> all = fine_regions();
    const auto pages = static_cast<std::uint64_t>(std::count(all.begin(), all.end(), true));
    ASSERT_GE(pages, 9U);
    const std::uint64_t page_bytes = (cache_->bytes() - coarse_bytes_) / pages;
    TearDown();
    start(coarse_bytes_ + 10 * page_bytes + page_bytes / 2);
    stay(14);
    pin({{0.19, 0.0}, {0.12, 0.12}, 0});
    stay(14);
    EXPECT_TRUE(fine_regions()[14]);
    stay(35); // a corner of the site
    EXPECT_TRUE(fine_regions()[35]);
    EXPECT_LE(cache_->bytes(), coarse_bytes_ + 10 * page_bytes + page_bytes / 2);
    presentation_.windows = {}; // put away
    stay(0);
    EXPECT_TRUE(fine_regions()[0]);
}

TEST_F(SiteWindows, DrawingAllocatesNothing) {
    if (!allocations_are_counted) {
        GTEST_SKIP() << "allocations are not counted under a sanitizer";
    }
    start(unlimited);
    const world::SiteView part = view_at(14);
    for (int frame = 0; frame < 60; ++frame) {
        draw(part, 14);
    }
    pin({{0.19, 0.0}, {0.12, 0.12}, 0});
    for (int frame = 0; frame < 40; ++frame) {
        draw(part, 14);
    }
    const long before = allocations_so_far();
    for (int frame = 0; frame < 10; ++frame) {
        table_.eye_m.x += 1e-3;
        draw(part, 14);
    }
    EXPECT_EQ(allocations_so_far() - before, 0);
}

} // namespace
} // namespace frustumscreen::synthetic
