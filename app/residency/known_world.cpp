#include "app/residency/known_world.h"

#include "app/pack/pack_relief.h"
#include "app/pack/pack_site.h"
#include "app/pack/pack_states.h"
#include "app/scene/cell_plan.h"

#include <algorithm>
#include <limits>
#include <map>
#include <span>
#include <utility>

namespace frustumscreen::residency {

namespace {

/// Reads a level of a region alone.
Result<PreparedLevel> read_level(const std::filesystem::path& file, const KnownWorld& known,
                                 const KnownCell& cell, std::uint32_t level,
                                 double max_samples_per_box = std::numeric_limits<double>::infinity()) {
    TRY(const pack::VerifiedPack pack,
        pack::load_cell(file, known.world.cells[cell.cell],
                        [&](const pack::PackOutline& own) -> Result<std::vector<std::uint32_t>> {
                            if (own != cell.outline) {
                                return bad_input(
                                    "show.region_changed",
                                    "the pack has changed since the exhibit was started; start it again");
                            }
                            return std::vector{level};
                        }));
    return prepare_level(*pack, level, cell.plan, {}, max_samples_per_box);
}

/// Reads the proxy; all levels are pages.
Result<void> prepare_region(const std::filesystem::path& file, const KnownWorld& known, const KnownCell& cell,
                            double texels_per_m, const std::function<bool()>& given_up,
                            PreparedCells& cells) {
    if (given_up()) {
        return bad_input("show.cells_not_wanted", "not wanted any more");
    }
    const std::vector<scene::QualityLevel> ways = region_ways_of(cell.plan);
    for (const scene::QualityLevel& way : ways) {
        PreparedLevel& page = cells.levels.emplace_back();
        page.use.level = way.level;
        page.use.triangles = cell.outline.levels[way.level].triangles;
        page.seen = cell.plan.seen[way.level];
        page.box_size = cell.outline.description.box_size;
        page.samples = cell.outline.description.samples;
    }
    TRY(PreparedLevel proxy,
        read_level(file, known, cell, ways.back().level, texels_per_m * cell.plan.metres_per_box));
    cells.levels.push_back(std::move(proxy));
    cells.options.push_back(ways.size() + 1);
    return {};
}

/// Reads the cell's pack once for all ways of drawing it.
Result<void> prepare_cell(const std::filesystem::path& file, const KnownWorld& known, const KnownCell& cell,
                          const std::function<bool()>& given_up, PreparedCells& cells) {
    TRY(const pack::VerifiedPack pack, pack::load_cell(file, known.world.cells[cell.cell]));
    if (pack::outline_of(*pack) != cell.outline) {
        return bad_input("show.cell_changed",
                         "the pack has changed since the exhibit was started; start it again");
    }
    const scene::ScenePlan& plan = cell.plan;
    const std::size_t first = cells.levels.size();
    std::map<std::uint32_t, std::shared_ptr<const relief::BlockRelief>>
        reliefs; // both ways of drawing share one
    const std::vector<scene::QualityLevel> ways = ways_of(plan);
    for (const scene::QualityLevel& way : ways) {
        if (given_up()) {
            return bad_input("show.cells_not_wanted", "not wanted any more");
        }
        if (!way.relief) {
            PreparedLevel level =
                prepare_level(*pack, way.level, plan, std::span(cells.levels).subspan(first));
            level.data.texture_of =
                level.data.texture_of ? std::optional(first + *level.data.texture_of) : std::nullopt;
            cells.levels.push_back(std::move(level));
            continue;
        }
        const auto place =
            std::find_if(plan.reliefs.begin(), plan.reliefs.end(),
                         [&](const pack::ReliefOutline& each) { return each.texels == way.level; });
        std::shared_ptr<const relief::BlockRelief>& relief = reliefs[way.level];
        if (!relief) {
            TRY(relief::BlockRelief read, pack::relief_of(*pack, *place));
            relief = std::make_shared<const relief::BlockRelief>(std::move(read));
        }
        cells.levels.push_back(prepare_relief(cell.outline.description,
                                              static_cast<std::size_t>(place - plan.reliefs.begin()), relief,
                                              way.on_gpu, plan));
    }
    cells.options.push_back(ways.size());
    return {};
}

} // namespace

std::vector<scene::QualityLevel> ways_of(const scene::ScenePlan& plan) {
    std::vector<scene::QualityLevel> ways;
    for (const scene::QualityLevel& quality_level : plan.quality_levels) {
        if (std::none_of(ways.begin(), ways.end(),
                         [&](const scene::QualityLevel& way) { return way.shows_as(quality_level); })) {
            ways.push_back(quality_level);
        }
    }
    return ways;
}

std::vector<scene::QualityLevel> region_ways_of(const scene::ScenePlan& plan) {
    std::vector<scene::QualityLevel> ways = ways_of(plan);
    std::stable_sort(
        ways.begin(), ways.end(),
        [](const scene::QualityLevel& a, const scene::QualityLevel& b) { return a.level > b.level; });
    return ways;
}

std::vector<PageName> pages_of(const KnownWorld& known) {
    std::vector<PageName> pages;
    std::size_t place = 0;
    for (std::size_t k = 0; known.is_site && k < known.drawn.size(); ++k) {
        const std::vector<scene::QualityLevel> ways = region_ways_of(known.drawn[k].plan);
        for (std::size_t way = 0; way < ways.size(); ++way) {
            pages.push_back({k, ways[way].level, place + way});
        }
        place += ways.size() + 1;
    }
    return pages;
}

Result<PreparedPage> prepare_page(const std::filesystem::path& file, const KnownWorld& known,
                                  const PageName& page) {
    TRY(PreparedLevel level, read_level(file, known, known.drawn[page.drawn], page.level));
    return PreparedPage{page.place, std::move(level)};
}

Result<std::shared_ptr<const KnownWorld>> open_world(const settings::Settings& settings,
                                                     const std::filesystem::path& file,
                                                     const pack::PackDescription& pack,
                                                     const scene::ScenePlan& whole,
                                                     const scene::SceneRequest& request) {
    TRY(pack::PackWorld outline, pack::world_outline_of(pack));
    outline.drawn_at_rest = outline.drawn_at_rest && request.technique == "auto";
    TRY(const std::vector<pack::PackState> states,
        settings.windows.exist() ? pack::states_of(pack) : std::vector<pack::PackState>());
    const bool hides = std::any_of(states.begin(), states.end(),
                                   [](const pack::PackState& state) { return !state.hidden.empty(); });
    TRY(const std::vector<pack::SiteRegion> regions, pack::site_regions_of(pack));
    if (outline.behaviours.empty() && !outline.drawn_at_rest && !hides && regions.empty()) {
        return nullptr;
    }
    return open_cells(settings, file, std::move(outline), whole, request, !regions.empty());
}

Result<std::shared_ptr<const KnownWorld>> open_cells(const settings::Settings& settings,
                                                     const std::filesystem::path& file,
                                                     pack::PackWorld outline, const scene::ScenePlan& whole,
                                                     const scene::SceneRequest& request, bool is_site) {
    auto known = std::make_shared<KnownWorld>();
    known->is_site = is_site;
    known->tolerance_mm =
        1e3 * settings.render.error_tolerance_px *
        scene::pixel_on_prop_m(whole.prop, whole.projector, whole.table_from_projector.inverse());
    known->world = std::move(outline);
    const std::vector<world::CellPose> at_rest = world::poses_at_rest(pack::tree_of(known->world));
    for (std::size_t k = 0; k < at_rest.size(); ++k) {
        if (!known->world.cells[k].cell.has_geometry) {
            continue;
        }
        KnownCell& cell = known->drawn.emplace_back();
        cell.cell = k;
        TRY_VOID(without_value(
            pack::load_cell(file, known->world.cells[k],
                            [&](const pack::PackOutline& own) -> Result<std::vector<std::uint32_t>> {
                                TRY(cell.plan, scene::plan_cell(settings, own, whole, at_rest[k], request));
                                cell.outline = own;
                                return std::vector<std::uint32_t>{};
                            })));
    }
    return known;
}

scene::RenderNeeds needs_of(const KnownWorld& world, const scene::RenderNeeds& whole) {
    scene::RenderNeeds needs = whole;
    for (const KnownCell& cell : world.drawn) {
        needs = scene::united(needs, cell.plan.needs);
    }
    for (scene::ShaderKey key : scene::RenderNeeds(needs).draws) {
        if (key.pass == scene::ShaderKey::Pass::Surface) {
            key.dithered = true;
            needs.draws.insert(key);
        }
    }
    return scene::with_cells(std::move(needs));
}

Result<PreparedCells> prepare_cells(const std::filesystem::path& file, const KnownWorld& known,
                                    const std::function<bool()>& given_up, double texels_per_m) {
    PreparedCells cells;
    for (const KnownCell& cell : known.drawn) {
        TRY_VOID(known.is_site ? prepare_region(file, known, cell, texels_per_m, given_up, cells)
                               : prepare_cell(file, known, cell, given_up, cells));
    }
    return cells;
}

} // namespace frustumscreen::residency
