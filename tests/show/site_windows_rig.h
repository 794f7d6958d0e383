/// Windows that show a part of a site, drawn as ArtifactShow draws them, and the rays that tell what each pixel shows.
///
/// Frames   as named; table T.
/// Threads  one.
#pragma once

#include "app/exhibit/site_places.h"
#include "app/show/window_show.h"
#include "firmware_host/display/surfaceless_display.h"
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

inline constexpr double zoom_in = 6.0;
inline constexpr std::uint64_t unlimited = std::uint64_t{1} << 40U;

/// A level of the regions alone; the last one is the finest.
inline pack::Pack region_level(bool fine) {
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
        if (has_torch_) {
            settings_.torch.source = settings::TorchSource::Tracker;
            known.plan.needs = scene::with_torches(std::move(known.plan.needs));
        }
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
    void pin(const typography::TableRectangle& rectangle, double brightness = 1.0, bool live = false) {
        presentation_.windows.add({.number = 1,
                                   .artifact = 0,
                                   .comings = 1,
                                   .rectangle = rectangle,
                                   .eye_m = table_.eye_m,
                                   .table_from_prop = table_.table_from_prop,
                                   .live = live,
                                   .brightness = brightness});
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
        seen.windows = windows_->place(now_, presentation_, std::span(&table_.eye_m, 1), *cache_, torches_);
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
    /// A pixel of the window and the region that it shows.
    struct Shown {
        bool in_window = false;
        std::optional<std::size_t> region;            ///< none: nothing
        glm::dvec3 point{0.0}, normal{0.0}, eye{0.0}; ///< in the frame of the prop that was pinned
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
        shown.eye = lit - along;
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
                shown.point = metres_per_box_ * part.point(met.point / double{site_rows} + middle);
                shown.normal = met.normal;
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
    bool has_torch_ = false;                  ///< before `start`: there may be torches
    std::vector<scene::PlacedTorch> torches_; ///< that light the prop
    pack::Pack fine_region_ = region_level(true), coarse_region_ = region_level(false);
    ReferenceCast fine_{fine_region_, 1.0}, coarse_{coarse_region_, 1.0};
    double metres_per_box_ = 1.0;
    std::uint64_t coarse_bytes_ = 0;
    MonotonicTime now_;
};

} // namespace frustumscreen::synthetic
