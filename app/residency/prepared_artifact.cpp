#include "app/residency/prepared_artifact.h"

#include "app/pack/pack_file.h"
#include "app/pack/pack_relief.h"
#include "app/residency/hotspot_show.h"
#include "app/scene/exposure.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace frustumscreen::residency {

namespace {

/// Reads one level, and fails if the pack has changed since it was opened.
Result<pack::VerifiedPack> read_level(const KnownArtifact& known, std::uint32_t level) {
    return pack::load_pack(
        known.file, [&](const pack::PackOutline& outline) -> Result<std::vector<std::uint32_t>> {
            if (outline != known.outline) {
                return bad_input("show.pack_changed",
                                 "the pack has changed since the exhibit was started; start it again");
            }
            return std::vector<std::uint32_t>{level};
        });
}

/// The mesh level that decides which hotspots are hidden, also when only reliefs are drawn.
std::uint32_t coarsest_of(const scene::ScenePlan& plan) {
    return plan.levels.empty() ? 0 : *std::min_element(plan.levels.begin(), plan.levels.end());
}

/// The levels to read without drawing them, when only reliefs are drawn: for the exposure and for the
/// visibility of hotspots.
std::vector<std::uint32_t> read_beside(const KnownArtifact& known) {
    const scene::ScenePlan& plan = known.plan;
    if (!plan.levels.empty()) {
        return {};
    }
    std::vector<std::uint32_t> levels{plan.exposure_level};
    if (!known.outline.description.hotspots.empty() && coarsest_of(plan) != plan.exposure_level) {
        levels.push_back(coarsest_of(plan));
    }
    return levels;
}

/// Without its texture.
std::uint64_t expected_bytes(const pack::LevelOutline& level) {
    constexpr std::uint64_t per_vertex = sizeof(pack::PackVertex) + sizeof(glm::vec3);
    constexpr std::uint64_t per_triangle = 3 * sizeof(std::uint32_t) + 4 * sizeof(float); // indices and plane
    return level.vertices * per_vertex + level.triangles * per_triangle;
}

/// The memory for the levels and reliefs that a plan reads. Levels share a texture.
std::uint64_t expected_bytes(const pack::PackOutline& outline, const scene::ScenePlan& plan,
                             std::uint64_t texture_bytes) {
    std::uint64_t bytes = 0;
    for (const std::uint32_t number : plan.levels) {
        bytes += expected_bytes(outline.levels[number]);
    }
    bytes += plan.levels.empty() ? 0 : texture_bytes;
    for (std::size_t place = 0; place < plan.reliefs.size(); ++place) {
        const std::uint64_t relief = plan.reliefs[place].bytes;
        constexpr std::uint64_t more_in_memory = 2; // in memory a cell's corners are stored together
        bytes += more_in_memory * relief + (draws_relief(plan, place, true) ? relief : 0);
    }
    return bytes;
}

/// The finest of the mesh levels'; infinite if there are none.
double texels_per_m(std::span<const PreparedLevel> levels, const scene::ScenePlan& plan) {
    double texels = 0.0;
    for (const PreparedLevel& level : levels) {
        texels = std::max(texels, level.data.texels_per_box / plan.metres_per_box);
    }
    return texels > 0.0 ? texels : std::numeric_limits<double>::infinity();
}

} // namespace

Result<PreparedArtifact> prepare_artifact(const KnownArtifact& known, const std::string& technique,
                                          double deadline_ms, const std::function<bool()>& given_up) {
    const scene::ScenePlan& plan = known.plan;
    std::vector<PreparedLevel> levels;
    double exposure = 1.0;
    exhibit::ArtifactTriangles triangles;
    const auto read = [&](std::uint32_t number) {
        Result<pack::VerifiedPack> pack = read_level(known, number);
        if (pack && number == plan.exposure_level) {
            const pack::PackLevel& level = (*pack)->levels[number];
            exposure = scene::exposure_of(level, (*pack)->box_size, (*pack)->textures[level.texture],
                                          plan.highlight_code);
        }
        if (pack && number == coarsest_of(plan) && !(*pack)->hotspots.empty()) {
            triangles = hiding_triangles((*pack)->levels[number], (*pack)->box_size, plan.metres_per_box);
        }
        return pack;
    };
    for (const std::uint32_t number : plan.levels) {
        if (given_up()) {
            return bad_input("show.artifact_not_wanted", "not wanted any more");
        }
        TRY(const pack::VerifiedPack pack, read(number));
        levels.push_back(prepare_level(*pack, number, plan, levels));
    }
    for (const std::uint32_t number : read_beside(known)) {
        if (given_up()) {
            return bad_input("show.artifact_not_wanted", "not wanted any more");
        }
        TRY_VOID(without_value(read(number)));
    }
    for (std::size_t place = 0; place < plan.reliefs.size(); ++place) {
        if (given_up()) {
            return bad_input("show.artifact_not_wanted", "not wanted any more");
        }
        TRY(relief::BlockRelief relief, pack::load_relief(known.file, plan.reliefs[place]));
        const auto shared = std::make_shared<const relief::BlockRelief>(std::move(relief));
        for (const bool on_gpu : {false, true}) {
            if (draws_relief(plan, place, on_gpu)) {
                levels.push_back(prepare_relief(known.outline.description, place, shared, on_gpu, plan));
            }
        }
    }
    PreparedArtifact made{.levels = RunLevels(technique, plan, deadline_ms, levels),
                          .data = {},
                          .exposure = exposure,
                          .triangles = std::move(triangles)};
    PreparedCells cells;
    if (known.world) {
        TRY(const pack::PackWorld world, pack::load_world(known.file));
        TRY(cells, prepare_cells(known.file, *known.world, given_up, texels_per_m(levels, plan)));
        made.cells = std::make_unique<RunCells>(world, *known.world, plan, levels, cells, deadline_ms);
        made.cells->add_states(world, known.states);
    }
    for (std::vector<PreparedLevel>* const prepared : {&levels, &cells.levels}) {
        std::vector<std::size_t> places; // in `made.data`
        for (PreparedLevel& level : *prepared) {
            places.push_back(made.data.size());
            if (level.triangles || level.data.relief) { // else it is a page
                scene::LevelData& data = made.data.emplace_back(std::move(level.data));
                data.texture_of = data.texture_of ? std::optional(places[*data.texture_of]) : std::nullopt;
            }
        }
    }
    if (std::optional<scene::LevelData> mark = made.cells ? made.cells->take_mark_data() : std::nullopt) {
        made.data.push_back(*std::move(mark));
    }
    return made;
}

Result<TextPictures> prepare_texts(const KnownArtifact& known, TextPart part, std::size_t language,
                                   const TextStyle& style, const std::function<bool()>& given_up) {
    return draw_texts({known.file, known.outline.description, known.plan.captions}, known.texts, part,
                      language, style, given_up);
}

std::uint64_t expected_page_bytes(const KnownWorld& world, const PageName& page,
                                  std::uint64_t texture_bytes) {
    return expected_bytes(world.drawn[page.drawn].outline.levels[page.level]) + texture_bytes;
}

std::uint64_t expected_bytes(const KnownArtifact& known, std::uint64_t texture_bytes) {
    std::uint64_t bytes = expected_bytes(known.outline, known.plan, texture_bytes);
    if (known.world) {
        for (const KnownCell& cell : known.world->drawn) {
            bytes += known.world->is_site
                         ? expected_bytes(cell.outline.levels[region_ways_of(cell.plan).back().level])
                         : expected_bytes(cell.outline, cell.plan, texture_bytes);
        }
    }
    if (!known.outline.description.hotspots.empty()) {
        bytes += geometry::TriangleTree::max_bytes(known.outline.levels[coarsest_of(known.plan)].triangles);
    }
    return bytes;
}

} // namespace frustumscreen::residency
