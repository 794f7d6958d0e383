// Windows that show a part of a site, against rays to the regions' own triangles: a window that was pinned in a region has all regions
// that its eye sees, also those that no face of the prop showed, and the preview shows the marked region as it will stand in the prop.

#include "app/exhibit/site_places.h"
#include "app/show/window_show.h"
#include "firmware_host/display/surfaceless_display.h"
#include "tests/render/counted_new.h"
#include "tests/render/keep_picture.h"
#include "tests/render/reference_cast.h"
#include "tests/render/rig.h"
#include "tests/show/site_pack.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace frustumscreen::synthetic {
namespace {

constexpr double zoom_in = 6.0;
constexpr std::uint64_t unlimited = std::uint64_t{1} << 40U;

/// A level of the regions alone; the last one is the finest.
pack::Pack region_level(bool fine) {
    pack::Pack pack = region_pack(0);
    pack.levels = {fine ? pack.levels.back() : pack.levels.front()};
    return pack;
}

class SiteWindows : public testing::Test {
protected:
    void start(std::uint64_t budget) {
        presentation_ = {};
        ASSERT_TRUE(write_file(file_, pack::write_pack(site_pack()).value()));
        settings_ = settings::steep_table();
        settings_.windows = {.count = 2, .width_m = 0.12, .depth_m = 0.12};
        scene::SceneRequest request;
        request.light = false;
        request.cull_kinds = scene::AllCullKinds & ~static_cast<unsigned>(scene::UnseenTriangles);
        residency::KnownArtifact known{
            .file = file_, .outline = pack::outline_of(*pack::load_pack(file_).value()), .plan = {}};
        known.plan = scene::plan_scene(settings_, known.outline, request).value();
        known.world =
            residency::open_world(settings_, file_, known.outline.description, known.plan, request).value();
        metres_per_box_ = known.plan.metres_per_box;
        ASSERT_TRUE(renderer_.prepare(residency::needs_of(*known.world, known.plan.needs)));
        residency::PreparedArtifact first =
            residency::prepare_artifact(known, "auto", 16.0, [] { return false; }).value();
        cache_ = std::make_unique<residency::ArtifactCache>(
            residency::ArtifactCacheSetUp{.artifacts = {known}, .budget_bytes = budget, .waits = true},
            std::move(first));
        ASSERT_TRUE(cache_->upload_first(renderer_.store()));
        coarse_bytes_ = cache_->bytes();
        const scene::PlanView view = table_.view();
        cache_->find(0)->measure(table_.prop, std::span(&view, 1), renderer_, {display_->framebuffer(), 0});
        cache_->start({}, table_.prop, view, table_.eye_m);
        windows_ = std::make_unique<show::WindowShow>(settings_, table_.prop, 1, true);
        ASSERT_TRUE(windows_->prepare(renderer_.store()));
        windows_->make_space(*cache_);
        presentation_.brightness = 1.0;
    }
    void TearDown() override {
        while (cache_ && cache_->release_some(renderer_.store())) {
        }
    }
    [[nodiscard]] residency::RunCells& cells() { return *cache_->find_cells(0); }
    /// Pins a window of what the prop shows.
    void pin(const typography::TableRectangle& rectangle) {
        presentation_.windows.add({.number = 1,
                                   .artifact = 0,
                                   .comings = 1,
                                   .rectangle = rectangle,
                                   .eye_m = table_.eye_m,
                                   .table_from_prop = table_.table_from_prop,
                                   .brightness = 1.0});
    }
    /// Stays there for two seconds.
    void stay(std::size_t region) {
        for (int frame = 0; frame < 100; ++frame) {
            draw(view_at(region), region);
        }
    }
    /// The view that has the region in the middle.
    [[nodiscard]] static world::SiteView view_at(std::size_t region) {
        static const pack::PackSite site = pack::site_of(site_pack()).value().value();
        return world::view_of(site.places[region], zoom_in);
    }
    /// One frame, as ArtifactShow; `marked`: the region that is gone to.
    void draw(const std::optional<world::SiteView>& part, std::optional<std::size_t> marked) {
        now_ += std::chrono::milliseconds(20);
        const std::array<std::size_t, 1> wanted{0};
        cache_->step(renderer_.store(),
                     {.shown = 0, .shown_language = "en", .wanted = wanted, .language = "en"});
        cells().show_site(part);
        cells().expect_site(marked ? std::optional(residency::RunCells::Goal{*marked, view_at(*marked)})
                                   : std::nullopt);
        const bool shows_cells = cells().step(now_, 1.0);
        presentation_.table_from_prop = table_.table_from_prop;
        scene::PlanView seen = table_.view();
        seen.windows =
            windows_->place(MonotonicTime{}, presentation_, std::span(&table_.eye_m, 1), *cache_, {});
        const render::RenderTarget target{display_->framebuffer(), 0};
        residency::RunLevels& levels = *cache_->find(0);
        const show::LentSpace lent(windows_.get(), shows_cells ? cells().plans() : levels.plans());
        if (shows_cells) {
            static_cast<void>(cells().draw(now_, levels.shown(), table_.prop, std::span(&seen, 1), renderer_,
                                           target, render::Redraw::Everything));
        } else {
            static_cast<void>(levels.draw(now_, table_.prop, std::span(&seen, 1), renderer_, target,
                                          render::Redraw::Everything));
        }
    }
    [[nodiscard]] image::Image8 picture() const {
        return render::read_colour(display_->framebuffer(), table_.projector.width, table_.projector.height);
    }
    /// As the window is pinned: from this eye, with the prop here.
    [[nodiscard]] scene::PinnedView pinned(const typography::TableRectangle& at,
                                           const TestTable& table) const {
        scene::WorldBall ball{.middle = table.prop.middle, .radius = 0.0};
        for (const glm::dvec3& corner : table.prop.corners) {
            ball.radius = std::fmax(ball.radius, glm::distance(corner, ball.middle));
        }
        return scene::pin_view({.table_from_prop = table.table_from_prop,
                                .prop_middle = table.prop.middle,
                                .eye_m = table.eye_m,
                                .world = ball,
                                .place = {.middle_m = at.centre_m,
                                          .yaw_rad = 0.5 * std::numbers::pi * at.quarter_turns,
                                          .width_m = at.size_m.x,
                                          .depth_m = at.size_m.y}})
            .value();
    }

    /// Whether the region's finest level is in memory: `show_part` draws it then.
    [[nodiscard]] std::array<bool, site_regions> fine_regions() {
        std::array<bool, site_regions> fine{};
        for (std::size_t region = 0; region < site_regions; ++region) {
            fine[region] = cells().uses()[3 * region].gpu_bytes > 0; // the finest is its first
        }
        return fine;
    }
    /// What the window shows at a pixel.
    struct Shown {
        bool in_window = false;
        std::optional<std::size_t> region; ///< none: nothing
    };
    [[nodiscard]] Shown shown_at(const glm::dvec2& pixel, const scene::PinnedView& view,
                                 const world::SiteView& part,
                                 const std::array<bool, site_regions>& is_fine) const {
        const glm::dvec3 from = table_.table_from_projector.translation;
        const glm::dvec3 ray = table_.table_from_projector.direction(table_.projector.ray(pixel));
        const geometry::RigidTransform prop_from_table = table_.table_from_prop.inverse();
        geometry::PropHit hit;
        const glm::dvec3 place = from - from.z / ray.z * ray;
        const glm::dvec3 at = view.table_from_window.inverse().point(place);
        const glm::dvec3& corner = view.surface.faces[0].corners[2];
        if (geometry::enter(table_.prop, prop_from_table.point(from), prop_from_table.direction(ray), hit) ||
            std::fabs(at.x) > corner.x || std::fabs(at.y) > corner.y) {
            return {};
        }
        const glm::dmat4 prop_from_seen =
            glm::inverse(view.window_from_prop) * view.table_from_window.inverse().matrix();
        const glm::dvec3 lit(prop_from_seen * glm::dvec4(place, 1.0));
        const glm::dvec3 along = lit - glm::dvec3(prop_from_seen * glm::dvec4(table_.eye_m, 1.0));
        Shown shown{.in_window = true, .region = {}};
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t region = 0; region < site_regions;
             ++region) { // what lies before the window is cut off
            const glm::dvec3 middle = view_at(region).place_at(glm::dvec3(0.0));
            const glm::dvec3 box = part.place_at(lit / metres_per_box_);
            const glm::dvec3 direction = along / metres_per_box_ / part.zoom;
            const ReferenceCast::Hit met =
                (is_fine[region] ? fine_ : coarse_)
                    .first_hit(double{site_rows} * (box - middle), double{site_rows} * direction);
            const double t =
                met.found ? glm::length(met.point - double{site_rows} * (box - middle)) : nearest;
            if (t < nearest) {
                nearest = t;
                shown.region = region;
            }
        }
        return shown;
    }
    struct Counts {
        std::size_t shown = 0, empty = 0, outline = 0, wrong = 0;
        std::set<std::size_t> regions;
    };
    static constexpr double outline_px = 1.0 / 16.0; ///< error of a drawn outline
    [[nodiscard]] bool differs_beside(const glm::dvec2& pixel, const Shown& own,
                                      const scene::PinnedView& view, const world::SiteView& part,
                                      const std::array<bool, site_regions>& is_fine) const {
        bool differs = false;
        for (int k = 0; k < 32 && !differs; ++k) {
            const double angle = k * std::numbers::pi / 8.0;
            const double r = outline_px * (k < 16 ? 0.5 : 1.0);
            const Shown beside =
                shown_at(pixel + r * glm::dvec2(std::cos(angle), std::sin(angle)), view, part, is_fine);
            differs = beside.in_window != own.in_window || beside.region != own.region;
        }
        return differs;
    }
    [[nodiscard]] Counts compare(const image::Image8& drawn, const scene::PinnedView& view,
                                 const world::SiteView& part) {
        const std::array<bool, site_regions> is_fine = fine_regions();
        Counts counts;
        for (int y = 0; y < drawn.height; ++y) {
            for (int x = 0; x < drawn.width; ++x) {
                const glm::dvec2 pixel(x + 0.5, y + 0.5);
                const Shown own = shown_at(pixel, view, part, is_fine);
                if (!own.in_window) {
                    continue;
                }
                counts.shown += own.region ? 1U : 0U;
                counts.empty += own.region ? 0U : 1U;
                if (own.region) {
                    counts.regions.insert(*own.region);
                }
                const glm::u8vec4 code = drawn.at(x, y);
                const bool is_right =
                    own.region ? code == glm::u8vec4(250, 250, region_blue(*own.region), 255) : code.r == 0;
                if (is_right) {
                    continue;
                }
                ++(differs_beside(pixel, own, view, part, is_fine) ? counts.outline : counts.wrong);
            }
        }
        return counts;
    }
    TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.path() / "site.fspack";
    settings::Settings settings_;
    TestTable table_{640, 400, false};
    std::unique_ptr<display::SurfacelessDisplay> display_ =
        display::SurfacelessDisplay::create(640, 400).value();
    render::Renderer renderer_ = render::Renderer::create(640, 400, scene::with_points(needs(1))).value();
    std::unique_ptr<residency::ArtifactCache> cache_;
    std::unique_ptr<show::WindowShow> windows_;
    exhibit::Presentation presentation_;
    pack::Pack fine_region_ = region_level(true), coarse_region_ = region_level(false);
    ReferenceCast fine_{fine_region_, 1.0}, coarse_{coarse_region_, 1.0};
    double metres_per_box_ = 1.0;
    std::uint64_t coarse_bytes_ = 0;
    MonotonicTime now_;
};

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
TEST_F(SiteWindows, LeaveTheMemoryToTheProp) {
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

TEST_F(SiteWindows, AllocateNothingInAFrame) {
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
