/// The cells of one artifact on the display: their levels in memory, the choice of one for each cell in each frame, the
/// fades between them, and the player that moves them.
///
/// Shown    while nothing moves, the whole artifact is drawn (run_levels.h). With a behaviour's first motion the cells take
///          its place in one frame, at rest, where both show the same within their errors. When everything is at rest
///          again and no cell fades, the picture fades back to the whole. Cells that the bake found quicker than the whole
///          (PackWorld::drawn_at_rest) are drawn always.
/// Choice   CellChoice: each option's error is the worst that its eyes see, its time that of its triangles or blocks and
///          of the cell's pixels (cell_plan.h), times the load that frames have shown. A rasterized
///          relief among polygons is drawn once more by the GPU, in each sample: on the software driver 10 ms of relief and
///          20 ms of polygons cost 40 ms together. So two choices are made, one of rasterized reliefs alone and one of all else,
///          and the better one is taken; only fades, and cells that have nothing else, mix them. Cells that are drawn at rest follow the
///          governor's first rule: a cell that has levels within the tolerance is drawn as the quickest of these, or, where
///          time is short, as a quicker one that errs more.
/// Site     of a site (pack_site.h) a part can be shown large (site_view.h). Then the cells are drawn, cut off by the prop's faces;
///          those that no face shows are left out. An error of a cell grows with the zoom, so finer levels come by the rule of cells that
///          are drawn at rest. The picture fades from the whole to the cells; the caller leaves the zoom at 1 for as long.
/// Pages    a site's region comes with the artifact as a proxy alone (known_world.h); its levels are pages. `wanted_pages` names those
///          that the shown part needs, then those of the parts in windows. The caller gives a page once it is in the store, and the cell
///          fades to it. Until then, and if memory is short, the next coarser level in the store is drawn, at last the proxy.
/// Threads  constructed on any thread; everything else on the render thread, with the display's context current.
///          `step`, `draw` and `record_time` allocate nothing.
/// Errors   none.
#pragma once

#include "app/pack/pack_states.h"
#include "app/render/renderer.h"
#include "app/residency/known_world.h"
#include "app/residency/run_levels.h"
#include "app/scene/cell_choice.h"
#include "app/scene/error_estimate.h"
#include "app/scene/frame_plan.h"
#include "app/scene/frame_time_model.h"
#include "app/scene/pinned_view.h"
#include "app/world/player.h"
#include "app/world/site_view.h"
#include "firmware_host/base/time.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace frustumscreen::residency {

/// LevelState::level while cells are drawn.
inline constexpr std::string_view level_of_cells = "cells";

class RunCells {
public:
    /// `world`: with its curves; `whole`: the artifact's plan. Drawing requires a drawable for each level.
    RunCells(const pack::PackWorld& world, const KnownWorld& known, const scene::ScenePlan& whole,
             std::span<const PreparedLevel> whole_levels, const PreparedCells& cells, double deadline_ms);

    /// Sets the drawable of the level with index `place`, which is in the store.
    void give(std::size_t place, const scene::Drawable& drawable, const render::GpuStore& store);
    /// Gives the cells' levels and reliefs the textures and colours of `layer.cells`. All levels must have been
    /// given.
    [[nodiscard]] Result<void> add_layer(render::GpuStore& store, const ReadLayer& layer);
    /// The artifact's states, which windows show. `world`: with its curves.
    void add_states(const pack::PackWorld& world, std::span<const pack::PackState> states);
    static constexpr std::size_t max_wanted_pages = 64;
    /// Pages for the next frames, by PreparedCells::levels, the most urgent first, also those that are there: of the regions that the
    /// latest picture shows, largest first; then of the place that is travelled to and of its neighbours; then of windows.
    [[nodiscard]] std::span<const std::size_t> wanted_pages() const { return wanted_; }
    /// Bytes of the texture that a page brings.
    [[nodiscard]] std::uint64_t page_texture_bytes(std::size_t place) const;
    /// Call when a page is in the store.
    void give_page(std::size_t place, const PreparedLevel& level, const scene::Drawable& drawable,
                   const render::GpuStore& store);
    /// Stops drawing a page, by a fade if it is visible. True: neither the prop nor a window shows it, so it may leave the store; then
    /// call `take_page`.
    [[nodiscard]] bool let_go(std::size_t place);
    void take_page(std::size_t place);

    /// Removes all given levels from the store, without pages; drawing is then impossible.
    void release(render::GpuStore& store);
    /// GPU memory and main memory, by the plan.
    [[nodiscard]] std::uint64_t bytes() const;
    [[nodiscard]] const std::vector<LevelUse>& uses() const { return uses_; }

    /// Sets the times of frames on this GPU. Without this call every cell is drawn at its best.
    void start(const scene::FrameCost& cost);
    /// Call when the artifact comes on show: everything returns to rest.
    void enter(MonotonicTime now) { player_.end_all(now); }

    [[nodiscard]] world::Player& player() { return player_; }
    /// The part of a site that the next frames show; none, as at the beginning: the whole. Not for other artifacts.
    void show_site(const std::optional<world::SiteView>& view) { site_ = view; }
    /// The part that is shown; none: the whole.
    [[nodiscard]] std::optional<world::SiteView> shown_part() const {
        return is_beyond() ? site_ : std::nullopt;
    }
    /// The region that the view travels to, or may travel to next, and how large it will be.
    struct Goal {
        std::size_t region = 0; ///< of the site's
        world::SiteView view;
    };
    void expect_site(const std::optional<Goal>& goal) { goal_ = goal; }
    [[nodiscard]] const std::optional<Goal>& goal() const { return goal_; }
    /// The parts of the site that windows show; their pages come last. At most settings::max_windows.
    void expect_in_windows(std::span<const world::SiteView> views);
    /// A region in a window: an option that it shows, and one that comes.
    struct SeenRegion {
        std::size_t shown = 0;
        std::optional<std::size_t> coming;
        MonotonicTime fade_start;
    };
    /// Adds the whole site as the prop shows it in this view, each region by its coarsest level that is good enough
    /// and in the store. To another level it fades as in the prop. `seen`: as the latest call for this window left
    /// it, when it made `parts`; empty at the first call.
    void show_part(MonotonicTime now, const world::SiteView& view, std::vector<SeenRegion>& seen,
                   std::vector<scene::Part>& parts) const;
    /// Marks a region of the miniature for the next frames; none: no mark.
    void mark(const std::optional<world::RegionBox>& region);
    /// The parts that RunLevels::draw draws beside the whole.
    [[nodiscard]] std::span<const scene::Part> marks() const { return marks_; }
    /// The mark of a site, to upload after the levels of the cells; none: it is no site.
    [[nodiscard]] std::optional<scene::LevelData> take_mark_data() {
        return std::exchange(mark_data_, std::nullopt);
    }
    /// Once a frame: moves the cells. True: `draw` draws this frame, otherwise the whole artifact's own RunLevels. `load`: of
    /// the GPU (see Governor), when the cells begin to show.
    [[nodiscard]] bool step(MonotonicTime now, double load);
    /// True if the latest step drew cells.
    [[nodiscard]] bool shows() const { return shows_; }
    /// True if a cell fades from one level to another, or the cells fade back to the whole.
    [[nodiscard]] bool fades() const;

    /// `whole`: what the artifact's RunLevels would draw; `views`: one for each eye of the scene plan.
    [[nodiscard]] render::DrawResult draw(MonotonicTime now, const scene::PlacedLevel& whole,
                                          const geometry::PropShape& prop,
                                          std::span<const scene::PlanView> views, render::Renderer& renderer,
                                          const render::RenderTarget& target, render::Redraw redraw);
    /// The latest `draw` took `ms` until its picture was complete.
    void record_time(MonotonicTime now, double ms);
    [[nodiscard]] double load() const;

    /// The error of the last frame: the mean over the cells by their pixels.
    [[nodiscard]] const std::optional<scene::ErrorEstimate>& error() const { return error_; }
    [[nodiscard]] std::uint64_t switches() const { return switches_; }
    /// The plan of each eye's latest picture.
    [[nodiscard]] std::span<const scene::FramePlan> plans() const { return plans_; }
    [[nodiscard]] std::span<scene::FramePlan> plans() { return plans_; }
    /// The cells in the latest picture, prop frame; empty: it showed the whole artifact.
    [[nodiscard]] std::span<const scene::Part> parts() const {
        return shows_ && !is_new_ ? std::span<const scene::Part>(parts_) : std::span<const scene::Part>();
    }

    /// Adds what a window shows of the cells in a state: one level each, the same at all times. False: a layer is not there yet.
    [[nodiscard]] bool show_state(std::size_t state, std::vector<scene::Part>& parts) const;
    /// The same, as the cells stand at the latest step.
    void show_moving(std::vector<scene::Part>& parts) const;
    /// Around all states and the cells at rest, prop frame; none: there are no states.
    [[nodiscard]] const std::optional<scene::WorldBall>& states_ball() const { return states_ball_; }

private:
    struct State {
        std::vector<world::CellPose> poses; ///< by the player's cells
        std::vector<bool> hidden;           ///< the same
        std::optional<std::size_t> layer;
    };
    struct Option {
        scene::SeenLevel seen;
        scene::PlacedLevel placed;
        double worst_mm = 0.0;
        double triangles = 0.0; ///< or blocks
        bool is_enough = false; ///< within the tolerance, at the zoom of this frame
        double enough_to = 0.0; ///< of a site: the largest zoom at which its surface is within the tolerance
        double sharp_from =
            0.0; ///< of a site: below this zoom the proxy, with the same surface, is drawn instead
        double sharp_to =
            std::numeric_limits<double>::infinity(); ///< the largest zoom at which its texture is fine enough
        bool there = true;                           ///< false: a page that is not in the store
        bool leaves = false;                         ///< a page that is not to be drawn any more
        int kept_out = 0; ///< steps during which windows do not want the page again
    };
    struct Cell {
        std::size_t number = 0;       ///< index into the player's cells
        std::size_t first = 0;        ///< of its options
        bool is_relief_alone = false; ///< it has rasterized reliefs and nothing else
        double pixels = 0.0;          ///< in this frame's picture of one eye
        std::size_t wanted = 0;       ///< index into its options
        std::size_t shown = 0;        ///< index of the option that is drawn, which is in the store
        std::optional<std::size_t> coming;
        MonotonicTime fade_start;
    };
    /// The option of a window; with a layer it is a mesh. None: the cell has no mesh.
    [[nodiscard]] std::optional<std::size_t> window_option(std::size_t cell, bool is_mesh) const;
    [[nodiscard]] scene::CellOption option_of(const Option& option, double pixels, double all_pixels,
                                              int samples) const;
    /// Sets the time of one cell's options, `begin` to `end`, to infinity, except of the quickest one within the
    /// tolerance and of those that are quicker with a larger error.
    void offer_enough(std::size_t begin, std::size_t end, std::vector<scene::CellOption>& offered) const;
    void choose(MonotonicTime now, int samples, const geometry::PropShape& prop, const scene::PlanView& view);
    [[nodiscard]] std::size_t end_of(std::size_t cell) const {
        return cell + 1 < cells_.size() ? cells_[cell + 1].first : options_.size();
    }
    /// The option to draw of a cell: the wanted one if it can be shown, otherwise a finer one, otherwise the next
    /// coarser one.
    [[nodiscard]] std::size_t nearest_there(const Cell& cell) const;
    /// False: at this zoom the proxy, or the page of the same level, is drawn instead.
    [[nodiscard]] static bool is_sharp(const Option& option, double zoom) {
        return option.sharp_from < zoom && zoom <= option.sharp_to;
    }
    [[nodiscard]] static bool is_good(const Option& option, double zoom) {
        return is_sharp(option, zoom) && zoom <= option.enough_to;
    }
    /// The quickest option of a cell that is good enough at a zoom.
    [[nodiscard]] std::size_t option_at(std::size_t cell, double zoom) const;
    /// From `option_at` on towards coarser ones, the first option that is in the store and stays there.
    [[nodiscard]] std::size_t option_in_window(std::size_t cell, double zoom) const;
    /// Sets `wanted_`.
    void want_pages();
    void want_page(std::size_t place);
    /// Wants the pages of the regions in the prop and within about its size around it, nearest first.
    void want_pages_around(const world::SiteView& view);
    /// A cell's pose in this frame, in the site's view.
    [[nodiscard]] world::CellPose pose_of(const Cell& cell) const;
    /// True if the zoom is not 1: the world reaches out of the prop.
    [[nodiscard]] bool is_beyond() const { return site_ && *site_ != world::SiteView{}; }
    [[nodiscard]] double zoom() const { return site_ ? site_->zoom : 1.0; }
    [[nodiscard]] bool chooses_enough() const { return drawn_at_rest_ || is_site_; }
    /// Sets which options of a site are within the tolerance at its zoom.
    void judge_options();
    /// The sums over all cells.
    [[nodiscard]] scene::CellOption sum(std::span<const std::size_t> chosen,
                                        const std::vector<scene::CellOption>& offered) const;
    /// Sets `rasterizes_all_`.
    void choose_kind(MonotonicTime now, const scene::CellOption& mixed, const scene::CellOption& rasterized,
                     double budget_us);
    [[nodiscard]] bool is_page(std::size_t option) const {
        return is_site_ && !std::binary_search(given_.begin(), given_.end(), option);
    }
    [[nodiscard]] bool is_rasterized(std::size_t option) const {
        return options_[option].placed.relief && !options_[option].placed.on_gpu;
    }
    void add_parts(MonotonicTime now, const scene::PlacedLevel& whole);
    void add_part(const Cell& cell, std::size_t option, int samples,
                  const std::optional<scene::Dither>& dither);
    [[nodiscard]] std::optional<scene::ErrorEstimate> estimate(const geometry::PropShape& prop,
                                                               std::span<const scene::PlanView> views) const;

    double metres_per_box_; ///< of the whole artifact
    double deadline_ms_;
    bool drawn_at_rest_;
    bool is_site_;
    std::optional<world::SiteView> site_;
    std::optional<scene::LevelData> mark_data_;
    scene::PlacedLevel mark_;
    std::vector<scene::Part> marks_;
    world::Player player_;
    std::span<const world::CellPose> poses_; ///< of the latest step
    std::vector<LevelUse> uses_;
    std::vector<Option> options_;
    std::vector<std::size_t> given_; ///< the options that come with the artifact
    std::vector<world::RegionBox> regions_;
    std::optional<Goal> goal_;
    std::array<world::SiteView, settings::max_windows> in_windows_{};
    std::size_t in_windows_count_ = 0;
    std::vector<std::size_t> wanted_, by_pixels_, targets_;
    std::vector<std::pair<double, std::size_t>> by_distance_;
    std::vector<Cell> cells_;
    scene::CellChoice choice_, rasterized_choice_;
    std::vector<scene::CellOption> offered_, rasterized_; ///< of each option, in this frame
    bool can_rasterize_all_ = false;
    bool rasterizes_all_ = false; ///< the choice of rasterized reliefs is drawn
    MonotonicTime kind_changed_;
    std::uint64_t switches_ = 0; ///< of cells, while they are on show
    scene::FrameCost cost_;
    double fixed_ms_ = 0.0;
    double expected_ms_ = 0.0; ///< of the chosen options, without load
    double log_load_ = 0.0;
    MonotonicTime timed_; ///< when the load was last learned
    std::vector<scene::Part> parts_;
    std::vector<State> states_;
    std::optional<scene::WorldBall> states_ball_;
    std::vector<scene::FramePlan> plans_; ///< one for each eye
    bool shows_ = false;
    bool is_new_ = false;                  ///< no picture of cells was drawn since they began to show
    std::optional<MonotonicTime> leaves_;  ///< since when the picture fades back to the whole
    std::optional<MonotonicTime> arrives_; ///< since when it fades from the whole to a site's cells
    std::optional<scene::ErrorEstimate> error_;
};

} // namespace frustumscreen::residency
