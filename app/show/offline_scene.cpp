#include "app/show/offline_scene.h"

#include "app/pack/pack_relief.h"
#include "app/pack/pack_states.h"
#include "app/pack/pack_world.h"
#include "app/render/renderer.h"
#include "app/scene/cell_plan.h"
#include "app/show/offline_site.h"
#include "app/show/offline_torch.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace frustumscreen::show {

namespace {

std::vector<std::uint32_t> levels_to_read(const scene::ScenePlan& plan, bool whole) {
    return plan.levels.empty() || !whole ? std::vector{plan.exposure_level} : plan.levels;
}

scene::SceneRequest request_of(const OfflineSetup& setup, const settings::Settings& settings,
                               const pack::PackDescription& whole) {
    const OfflineOptions& options = setup.options;
    scene::SceneRequest request;
    request.technique = options.technique;
    request.live = false;
    request.light = options.light;
    request.samples = samples_of(options, whole);
    request.sample_headroom = render::default_samples;
    request.cull_kinds = options.cull_kinds;
    if (options.windows > 0) { // a window may show other sides to the eye than the prop does
        request.cull_kinds &= ~static_cast<unsigned>(scene::UnseenTriangles);
    }
    if (!options.views.empty()) {
        request.visibility = scene::visibility_of(settings, options.views);
    }
    return request;
}

Result<std::size_t> find_behaviour(const pack::PackWorld& world, const std::string& name) {
    if (world.behaviours.empty()) {
        return bad_input("render.no_behaviours",
                         "--behaviour {}: the pack has no behaviours; leave the option out", name);
    }
    std::string names;
    for (std::size_t k = 0; k < world.behaviours.size(); ++k) {
        const std::string& each = world.behaviours[k].behaviour.name;
        if (each == name) {
            return k;
        }
        names += (k == 0 ? "" : ", ") + each;
    }
    return bad_input("render.no_behaviour", "--behaviour {}: the pack has no such behaviour; it has {}", name,
                     names);
}

Result<pack::PackState> find_state(const pack::PackDescription& pack, const std::string& name) {
    TRY(const std::vector<pack::PackState> states, pack::states_of(pack));
    std::string names;
    for (const pack::PackState& state : states) {
        if (state.name == name) {
            return state;
        }
        names += (names.empty() ? "" : ", ") + state.name;
    }
    return bad_input("render.no_state", "--state {}: the pack has no such state; it has {}", name,
                     names.empty() ? "none" : names);
}

/// Holds the cells as they are at the state's behaviour's end, and leaves out those that are hidden.
Result<void> hold_state(const pack::PackState& state, const pack::PackWorld& world, OfflineWorld& read) {
    if (state.behaviour) {
        read.behaviour = world.behaviours.at(*state.behaviour).behaviour;
        read.behaviour.repeats = false;
        read.behaviour.stays = true;
        read.held_s = 2.0 * read.behaviour.seconds; // then it is still
    }
    std::erase_if(read.drawn, [&](const OfflineCell& cell) {
        return std::find(state.hidden.begin(), state.hidden.end(), cell.cell) != state.hidden.end();
    });
    if (read.drawn.empty()) {
        return bad_input("render.empty_state",
                         "--state {}: it hides every part of the artifact; name another state", state.name);
    }
    return {};
}

/// The level of a site's region at a zoom: the coarsest level within the tolerance, otherwise the finest.
Result<std::string> technique_at(const settings::Settings& settings, const pack::PackOutline& region,
                                 const scene::ScenePlan& whole, double metres_per_box) {
    TRY(const scene::SeenByEyes seen, scene::seen_by_eyes(region));
    const double tolerance_mm =
        1e3 * settings.render.error_tolerance_px *
        scene::pixel_on_prop_m(whole.prop, whole.projector, whole.table_from_projector.inverse());
    std::size_t level = 0;
    while (level + 1 < region.levels.size() &&
           !scene::within_tolerance(region.levels[level].error, scene::worst_of(seen.levels[level]),
                                    1e3 * metres_per_box, tolerance_mm)) {
        ++level;
    }
    return fmt::format("level{}", level);
}

/// Reads the cell's level or relief.
Result<OfflineCell> load_offline_cell(const std::filesystem::path& file, const OfflineScene& scene,
                                      const pack::PackCell& cell, std::size_t number,
                                      const world::CellPose& at_rest) {
    const settings::Settings settings = sized(scene.setup);
    scene::ScenePlan plan;
    Result<pack::VerifiedPack> pack = pack::load_cell(
        file, cell, [&](const pack::PackOutline& outline) -> Result<std::vector<std::uint32_t>> {
            scene::SceneRequest request = request_of(scene.setup, settings, *scene.pack);
            if (const auto& site = scene.setup.options.site; site && request.technique == "auto") {
                const double at_rest_m = scene::metres_per_box_of(at_rest, scene.plan.metres_per_box);
                TRY(request.technique, technique_at(settings, outline, scene.plan, site->zoom * at_rest_m));
            }
            TRY(plan, scene::plan_cell(settings, outline, scene.plan, at_rest, request));
            return plan.levels;
        });
    TRY_VOID(pack);
    OfflineCell read{.cell = number, .plan = std::move(plan), .pack = *std::move(pack), .relief = nullptr};
    if (!read.plan.reliefs.empty()) {
        TRY(const pack::VerifiedPack all, pack::load_cell(file, cell));
        TRY(relief::BlockRelief relief, pack::relief_of(*all, read.plan.reliefs.front()));
        read.relief = std::make_shared<const relief::BlockRelief>(std::move(relief));
    }
    return read;
}

Result<OfflineWorld> load_offline_world(const std::filesystem::path& file, const OfflineScene& scene) {
    TRY(const pack::PackWorld world, pack::load_world(file));
    OfflineWorld read;
    if (const std::string& name = scene.setup.options.behaviour; !name.empty()) {
        TRY(const std::size_t behaviour, find_behaviour(world, name));
        read.behaviour = world.behaviours[behaviour].behaviour;
    }
    if (const auto& site = scene.setup.options.site) {
        TRY(read.site, offline_site_view(file, *scene.pack, scene.plan, *site));
    }
    read.cells = pack::tree_of(world);
    const std::vector<world::CellPose> at_rest = world::poses_at_rest(read.cells);
    for (std::size_t k = 0; k < world.cells.size(); ++k) {
        if (world.cells[k].cell.has_geometry) {
            TRY(OfflineCell cell, load_offline_cell(file, scene, world.cells[k], k, at_rest[k]));
            read.drawn.push_back(std::move(cell));
        }
    }
    if (const std::string& name = scene.setup.options.state; !name.empty()) {
        TRY(const pack::PackState state, find_state(*scene.pack, name));
        TRY_VOID(hold_state(state, world, read));
    }
    return read;
}

/// A behaviour is drawn with the cells, and so are a state of them and a pack whose cells are quicker than the whole.
Result<bool> draws_cells(const OfflineOptions& options, const pack::PackDescription& pack) {
    if (!options.behaviour.empty() || options.site) {
        return true;
    }
    if (!options.state.empty()) {
        TRY(const pack::PackState state, find_state(pack, options.state));
        if (state.behaviour || !state.hidden.empty()) {
            return true;
        }
    }
    TRY(const pack::PackWorld world, pack::world_outline_of(pack));
    return world.drawn_at_rest && options.technique == "auto";
}

} // namespace

/// The finest level is chosen where cost does not matter, so it gets the smoothest outlines too.
int samples_of(const OfflineOptions& options, const pack::PackDescription& pack) {
    const int usual = options.technique == "finest" ? render::finest_samples : pack.samples;
    return options.samples > 0 ? options.samples : usual;
}

settings::Settings sized(const OfflineSetup& setup) {
    const auto& [checked, options] = setup;
    settings::Settings settings = *checked;
    if (!options.both_eyes) {
        settings.projector.stereo = settings::OutputStereo::Off;
    }
    if (options.width > 0 && options.height > 0) {
        settings.projector.pinhole = settings.projector.pinhole.scaled_to(options.width, options.height);
    }
    return settings;
}

Result<OfflineScene>
load_offline(const std::filesystem::path& file,
             const std::function<Result<OfflineSetup>(const pack::PackOutline&)>& setup_of) {
    std::optional<OfflineSetup> setup;
    scene::ScenePlan plan;
    bool cells = false;
    Result<pack::VerifiedPack> pack =
        pack::load_pack(file, [&](const pack::PackOutline& outline) -> Result<std::vector<std::uint32_t>> {
            TRY(OfflineSetup made, setup_of(outline));
            const settings::Settings settings = sized(made);
            TRY(plan, scene::plan_scene(settings, outline, request_of(made, settings, outline.description)));
            TRY(cells, draws_cells(made.options, outline.description));
            setup = std::move(made);
            return levels_to_read(plan, !cells);
        });
    TRY_VOID(pack);
    OfflineScene scene{.setup = *std::move(setup),
                       .plan = std::move(plan),
                       .pack = *std::move(pack),
                       .relief = nullptr,
                       .world = std::nullopt};
    if (cells) {
        TRY(scene.world, load_offline_world(file, scene));
    } else if (!scene.plan.reliefs.empty()) {
        TRY(relief::BlockRelief relief, pack::load_relief(file, scene.plan.reliefs.front()));
        scene.relief = std::make_shared<const relief::BlockRelief>(std::move(relief));
    }
    if (const std::string& name = scene.setup.options.state; !name.empty()) {
        TRY(const pack::PackState state, find_state(*scene.pack, name));
        if (state.layer) {
            TRY(scene.look, load_offline_layer(file, scene, *state.layer));
        }
    }
    if (!scene.setup.options.torch.empty()) {
        TRY(scene.torch, load_offline_torch(file, scene, scene.setup.options.torch));
    }
    return scene;
}

} // namespace frustumscreen::show
