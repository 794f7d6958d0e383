/// The cells of an artifact that its behaviours move, or that are drawn at rest: how each is drawn, before any of it is
/// loaded, and their levels, read and ready to upload.
///
/// Site     each region has a proxy, read with the artifact: its coarsest level, with texels no finer than the miniature's.
///          All of a region's levels are pages, each read with its whole texture when wanted (RunCells::wanted_pages).
/// Memory   before the artifact is about to be shown, only the manifests: no curves. While cells are prepared, one cell's pack at a time.
/// Threads  pure except for reading the file; any.
/// Errors   as load_pack and plan_cell; a pack that has changed since its plan was made.
#pragma once

#include "app/pack/pack_world.h"
#include "app/residency/run_levels.h"
#include "app/scene/scene_plan.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace frustumscreen::residency {

/// A cell with geometry.
struct KnownCell {
    std::size_t cell = 0; ///< index into KnownWorld::world.cells
    pack::PackOutline outline;
    scene::ScenePlan plan;
};
struct KnownWorld {
    pack::PackWorld world; ///< without curves
    std::vector<KnownCell> drawn;
    bool is_site = false;      ///< the cells are regions, which can be shown large
    double tolerance_mm = 0.0; ///< of a site's regions at any zoom
};

/// Null: no cell is ever drawn. Cells are drawn for behaviours, in a site, at rest (PackWorld::drawn_at_rest, technique `auto`)
/// and for a window's state that hides some of them. `whole`: the artifact's plan; `request`: the request that it was made for.
[[nodiscard]] Result<std::shared_ptr<const KnownWorld>> open_world(const settings::Settings& settings,
                                                                   const std::filesystem::path& file,
                                                                   const pack::PackDescription& pack,
                                                                   const scene::ScenePlan& whole,
                                                                   const scene::SceneRequest& request);

/// As above for a known outline, also if it has no behaviours.
[[nodiscard]] Result<std::shared_ptr<const KnownWorld>>
open_cells(const settings::Settings& settings, const std::filesystem::path& file, pack::PackWorld outline,
           const scene::ScenePlan& whole, const scene::SceneRequest& request, bool is_site = false);

/// The needs of a renderer for the whole artifact and all of its cells, which fade into each other.
[[nodiscard]] scene::RenderNeeds needs_of(const KnownWorld& world, const scene::RenderNeeds& whole);

/// The ways in which a quality level draws a cell, each once, best first.
[[nodiscard]] std::vector<scene::QualityLevel> ways_of(const scene::ScenePlan& plan);
/// The same for a region of a site, finest first: the zoom decides which of them is good enough.
[[nodiscard]] std::vector<scene::QualityLevel> region_ways_of(const scene::ScenePlan& plan);

/// A level of a region, read after its artifact.
struct PageName {
    std::size_t drawn = 0;   ///< index into KnownWorld::drawn
    std::uint32_t level = 0; ///< of the region's pack
    std::size_t place = 0;   ///< index into PreparedCells::levels; the region's proxy follows its pages
};
/// None for a world that is no site.
[[nodiscard]] std::vector<PageName> pages_of(const KnownWorld& known);
struct PreparedPage {
    std::size_t place = 0;
    PreparedLevel level;
};
[[nodiscard]] Result<PreparedPage> prepare_page(const std::filesystem::path& file, const KnownWorld& known,
                                                const PageName& page);

/// The levels of all cells, one cell after another.
struct PreparedCells {
    std::vector<std::size_t> options; ///< number of levels of each of KnownWorld::drawn
    std::vector<PreparedLevel> levels;
};
/// `given_up`: asked between two levels; true cancels the preparation. `texels_per_m`: of the whole artifact's
/// texture, on its surface in the prop; a region's proxy has no finer one.
[[nodiscard]] Result<PreparedCells>
prepare_cells(const std::filesystem::path& file, const KnownWorld& known,
              const std::function<bool()>& given_up,
              double texels_per_m = std::numeric_limits<double>::infinity());

} // namespace frustumscreen::residency
