// A site of 36 regions in the artifact cache, while a visitor travels from region to region: bytes in memory, by the store and by the
// cache, and the triangles that are drawn.
#include "app/residency/artifact_cache.h"
#include "firmware_host/display/surfaceless_display.h"
#include "tests/render/counted_new.h"
#include "tests/show/site_pack.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <thread>
#include <vector>

namespace frustumscreen::synthetic {
namespace {

constexpr double site_zoom = 6.0;
constexpr std::uint64_t no_limit = std::uint64_t{1} << 40U;

class SitePages : public testing::Test {
protected:
    void start(std::uint64_t budget, bool waits) {
        ASSERT_TRUE(write_file(file_, pack::write_pack(site_pack()).value()));
        scene::SceneRequest request;
        request.light = false;
        request.cull_kinds = scene::AllCullKinds & ~static_cast<unsigned>(scene::UnseenTriangles);
        const settings::Settings settings = settings::steep_table();
        residency::KnownArtifact known{
            .file = file_, .outline = pack::outline_of(*pack::load_pack(file_).value()), .plan = {}};
        known.plan = scene::plan_scene(settings, known.outline, request).value();
        known.world =
            residency::open_world(settings, file_, known.outline.description, known.plan, request).value();
        ASSERT_TRUE(known.world && known.world->is_site);
        ASSERT_EQ(residency::pages_of(*known.world).size(), 2 * site_regions);
        known_ = known.world;
        ASSERT_TRUE(renderer_.prepare(residency::needs_of(*known.world, known.plan.needs)));
        Result<residency::PreparedArtifact> first =
            residency::prepare_artifact(known, "auto", 16.0, [] { return false; });
        ASSERT_TRUE(first) << first.error().message;
        cache_ = std::make_unique<residency::ArtifactCache>(
            residency::ArtifactCacheSetUp{.artifacts = {known}, .budget_bytes = budget, .waits = waits},
            *std::move(first));
        ASSERT_TRUE(cache_->upload_first(renderer_.store()));
        const scene::PlanView view = table_.view();
        levels().measure(table_.prop, std::span(&view, 1), renderer_, {display_->framebuffer(), 0});
        coarse_bytes_ = cache_->bytes();
        cache_->start({}, table_.prop, view, table_.eye_m);
    }
    void TearDown() override {
        while (cache_ && cache_->release_some(renderer_.store())) {
        }
    }
    [[nodiscard]] residency::RunLevels& levels() { return *cache_->find(0); }
    [[nodiscard]] residency::RunCells& cells() { return *cache_->find_cells(0); }
    [[nodiscard]] static glm::dvec3 middle_of(std::size_t region) {
        return site_pack_outline().places[region];
    }
    [[nodiscard]] static const pack::PackSite& site_pack_outline() {
        static const pack::PackSite site = pack::site_of(site_pack()).value().value();
        return site;
    }
    /// One frame, as ArtifactShow.
    void draw(const std::optional<world::SiteView>& view, std::optional<std::size_t> goal) {
        now_ += std::chrono::milliseconds(20);
        const std::array<std::size_t, 1> wanted{0};
        cache_->step(renderer_.store(),
                     {.shown = 0, .shown_language = "en", .wanted = wanted, .language = "en"});
        cells().show_site(view);
        cells().expect_site(goal ? std::optional(residency::RunCells::Goal{
                                       *goal, world::view_of(middle_of(*goal), site_zoom)})
                                 : std::nullopt);
        const scene::PlanView seen = table_.view();
        const render::RenderTarget target{display_->framebuffer(), display_->buffer_age()};
        const render::DrawResult drawn =
            cells().step(now_, 1.0) ? cells().draw(now_, levels().shown(), table_.prop, std::span(&seen, 1),
                                                   renderer_, target, render::Redraw::Changes)
                                    : levels().draw(now_, table_.prop, std::span(&seen, 1), renderer_, target,
                                                    render::Redraw::Changes);
        if (drawn.drawn) {
            ASSERT_TRUE(display_->present(now_));
        }
        max_bytes_ = std::max(max_bytes_, cache_->bytes());
        max_store_bytes_ = std::max(max_store_bytes_, renderer_.store().bytes());
        ASSERT_FALSE(cells().shows() && cells().parts().empty());
    }
    /// Its two levels, finest first, and its proxy.
    [[nodiscard]] std::span<const residency::LevelUse> uses_of(std::size_t region) {
        return std::span(cells().uses()).subspan(3 * region, 3);
    }
    /// Regions whose finest level is there.
    [[nodiscard]] std::set<std::size_t> pages_there() {
        std::set<std::size_t> regions;
        for (std::size_t region = 0; region < site_regions; ++region) {
            const bool there = uses_of(region)[0].gpu_bytes > 0;
            if (there) {
                regions.insert(region);
            }
        }
        return regions;
    }
    /// The bytes of all loaded pages, after another read of each.
    [[nodiscard]] std::uint64_t bytes_of_pages_there() {
        std::uint64_t bytes = 0;
        for (const residency::PageName& page : residency::pages_of(*known_)) {
            if (cells().uses()[page.place].gpu_bytes > 0) {
                bytes +=
                    residency::LoadedPage(residency::prepare_page(file_, *known_, page).value(), 1).bytes();
            }
        }
        return bytes;
    }
    /// Goes there from above the region before, and stays for a second.
    void travel_to(std::size_t region, std::optional<std::size_t> from) {
        const world::SiteView goal = world::view_of(middle_of(region), site_zoom);
        const world::SiteView begin = from ? world::view_of(middle_of(*from), site_zoom) : world::SiteView{};
        for (int frame = 0; frame < 40; ++frame) {
            draw(world::between(begin, goal, frame / 40.0), region);
        }
        for (int frame = 0; frame < 50; ++frame) {
            draw(goal, region);
        }
    }
    static bool is_fine(const scene::Part& part) { return part.level.triangles->indices.size() > 3U * 1000; }
    /// The share of the light that the finest level of the region in the middle has in the latest picture.
    [[nodiscard]] float fine_share() {
        float share = 0.0F;
        for (const scene::Part& part : cells().parts()) {
            if (glm::length(glm::dvec3(part.level.prop_from_placed[3])) < 1e-9 && is_fine(part)) {
                share = !part.dither              ? 1.0F
                        : part.dither->complement ? 1.0F - part.dither->share
                                                  : part.dither->share;
            }
        }
        return share;
    }

    TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.path() / "site.fspack";
    TestTable table_{320, 200};
    std::unique_ptr<display::SurfacelessDisplay> display_ =
        display::SurfacelessDisplay::create(320, 200).value();
    render::Renderer renderer_ = render::Renderer::create(320, 200).value();
    std::unique_ptr<residency::ArtifactCache> cache_;
    std::shared_ptr<const residency::KnownWorld> known_;
    std::uint64_t coarse_bytes_ = 0, max_bytes_ = 0, max_store_bytes_ = 0;
    MonotonicTime now_;
};

constexpr std::array<std::size_t, 5> journey{7, 28, 0, 35, 14};

TEST_F(SitePages, LoadForEachPlaceWithinTheMemoryBudget) {
    start(no_limit, true);
    draw(std::nullopt, std::nullopt);
    EXPECT_TRUE(pages_there().empty()); // the miniature needs none
    const std::uint64_t coarse_store_bytes = renderer_.store().bytes();
    travel_to(journey[0], std::nullopt);
    const std::size_t at_once = pages_there().size();
    EXPECT_GE(at_once, 9U); // the region and its eight neighbours
    EXPECT_EQ(cache_->bytes(), coarse_bytes_ + bytes_of_pages_there());
    const std::uint64_t page_bytes = (cache_->bytes() - coarse_bytes_) / at_once;
    TearDown();

    const std::uint64_t budget = coarse_bytes_ + 12 * page_bytes + page_bytes / 2;
    max_bytes_ = max_store_bytes_ = 0;
    start(budget, true);
    std::optional<std::size_t> from;
    std::set<std::size_t> ever;
    for (const std::size_t region : journey) {
        travel_to(region, from);
        from = region;
        ever.merge(pages_there());
        EXPECT_EQ(fine_share(), 1.0F) << region;
        EXPECT_TRUE(pages_there().contains(region)) << region;
        EXPECT_LE(pages_there().size(), 12U) << region;
    }
    EXPECT_LE(max_bytes_, budget);
    EXPECT_GT(max_bytes_, budget - page_bytes);
    EXPECT_LT(max_store_bytes_ - coarse_store_bytes, 14 * page_bytes);
    EXPECT_GT(ever.size(), 12U); // more than fit at once
    EXPECT_EQ(cache_->bytes(), coarse_bytes_ + bytes_of_pages_there());
}

/// Bytes in the store, counted by hand: the site's two levels share a texture, and a proxy's texels lie no closer on the prop than
/// the site's.
TEST_F(SitePages, OnlyProxiesAreLoadedWithTheArtifact) {
    constexpr std::uint64_t whole_texels = 64 * 64 + 32 * 32 + 16 * 16 + 8 * 8 + 4 * 4;
    constexpr std::uint64_t stand_in_texels = 8 * 8 + 4 * 4; // 64 / 6 texels along a side, or fewer
    const std::uint64_t before = renderer_.store().bytes();
    start(no_limit, true);
    std::uint64_t vertices = 0;
    for (const residency::LevelUse& use : levels().uses()) {
        vertices += use.planned_gpu_bytes;
    }
    vertices -= 4 * whole_texels;
    const pack::Pack region = region_pack(0);
    vertices += site_regions * sizeof(pack::PackVertex) * region.levels.front().vertices.size();
    const std::uint64_t mark = cells().uses().back().gpu_bytes;
    EXPECT_EQ(renderer_.store().bytes() - before,
              vertices + mark + 4 * (whole_texels + site_regions * stand_in_texels));
    for (std::size_t k = 0; k < site_regions; ++k) {
        EXPECT_EQ(uses_of(k)[2].level, 0U)
            << k; // the coarsest, although the miniature is drawn by it at its best
        EXPECT_EQ(uses_of(k)[2].texture, glm::ivec2(8, 8)) << k;
        EXPECT_EQ(uses_of(k)[0].gpu_bytes + uses_of(k)[1].gpu_bytes, 0U) << k;
    }
}

/// In the miniature the proxy is all that is needed; a little larger, its level comes with the whole texture.
TEST_F(SitePages, TextureAloneIsLoadedWhereTheProxysSurfaceIsGoodEnough) {
    start(no_limit, true);
    scene::FrameCost cost; // without times the best level is drawn
    cost.mesh.ms_per_triangle = 1e-6;
    cells().start(cost);
    const auto draw_at = [&](double zoom) {
        for (int frame = 0; frame < 60; ++frame) {
            draw(world::view_of(middle_of(14), zoom), std::nullopt);
        }
    };
    draw_at(1.2);
    EXPECT_EQ(bytes_of_pages_there(), 0U);
    draw_at(1.9);
    EXPECT_GT(uses_of(14)[1].gpu_bytes, 0U);
    EXPECT_EQ(uses_of(14)[1].texture, glm::ivec2(64, 64));
    EXPECT_TRUE(pages_there().empty());
}

TEST_F(SitePages, RegionsStayCoarseIfTheMemoryIsTooSmall) {
    start(1, true);
    travel_to(journey[0], std::nullopt);
    EXPECT_TRUE(pages_there().empty());
    EXPECT_EQ(fine_share(), 0.0F);
    EXPECT_EQ(cache_->bytes(), coarse_bytes_);
}

/// Until the reader has brought a page, its region is drawn by the coarser level; then the finer one fades in.
TEST_F(SitePages, FadeInOverTheCoarserLevel) {
    start(no_limit, false);
    const std::size_t region = journey[0];
    const world::SiteView view = world::view_of(middle_of(region), site_zoom);
    draw(view, std::nullopt); // nothing was expected
    EXPECT_TRUE(pages_there().empty());
    for (const scene::Part& part : cells().parts()) {
        EXPECT_FALSE(is_fine(part));
    }
    float last = 0.0F;
    int between = 0;
    for (int frame = 0; frame < 20'000 && last < 1.0F; ++frame) {
        draw(view, std::nullopt);
        const float share = fine_share();
        EXPECT_GE(share, last);
        EXPECT_LE(share - last, 0.06F); // 20 ms of 400 ms
        between += share > 0.0F && share < 1.0F ? 1 : 0;
        last = share;
        std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    EXPECT_EQ(last, 1.0F);
    EXPECT_GE(between, 18);
}

TEST_F(SitePages, DrawingLoadedPagesAllocatesNothing) {
    if (!allocations_are_counted) {
        GTEST_SKIP() << "allocations are not counted under a sanitizer";
    }
    start(no_limit, true);
    travel_to(journey[0], std::nullopt);
    const world::SiteView view = world::view_of(middle_of(journey[0]), site_zoom);
    draw(view, journey[0]);
    const long before = allocations_so_far();
    for (int frame = 0; frame < 20; ++frame) {
        table_.eye_m.x += 1e-3;
        draw(view, journey[0]);
    }
    EXPECT_EQ(allocations_so_far() - before, 0);
}

} // namespace
} // namespace frustumscreen::synthetic
