#include "app/residency/known_model.h"

#include "app/pack/pack_file.h"
#include "app/scene/governor.h"
#include "app/scene/inner_box.h"
#include "app/scene/scene_level.h"

#include <utility>

namespace frustumscreen::residency {

namespace {

KnownQualityLevel known_level_of(const scene::QualityLevel& shows, std::uint32_t number,
                                 const pack::LevelError& error, scene::SeenLevel seen, double work,
                                 std::uint64_t bytes) {
    const pack::SeenError worst = scene::worst_of(seen);
    const auto mean_box = static_cast<double>(worst.mean_box);
    return {.name = scene::name_of(shows),
            .number = number,
            .relief = shows.relief,
            .seen = std::move(seen),
            .mean_box = mean_box,
            .judged_box = scene::judged_error(error, worst),
            .work = work,
            .bytes = bytes};
}

Result<pack::VerifiedPack> load_level(const KnownModel& model, std::uint32_t level) {
    return pack::load_pack(
        model.file, [level, &model](const pack::PackOutline& outline) -> Result<std::vector<std::uint32_t>> {
            if (level >= outline.levels.size() || outline.description.box_size != model.box_size) {
                return bad_input("room.pack_changed",
                                 "the pack has changed since the exhibit was started; start it again");
            }
            return std::vector<std::uint32_t>{level};
        });
}

ReadQualityLevel read_relief(relief::BlockRelief relief) {
    ReadQualityLevel read;
    read.bytes = relief::bytes_of(relief);
    read.data.relief = std::make_shared<const relief::BlockRelief>(std::move(relief));
    return read;
}

} // namespace

Result<KnownModel> know_model(const std::filesystem::path& file) {
    pack::PackOutline outline;
    TRY_VOID(without_value(pack::load_pack(file, [&](const pack::PackOutline& found) {
        outline = found;
        return Result<std::vector<std::uint32_t>>();
    })));
    TRY(scene::SeenByEyes seen, scene::seen_by_eyes(outline));
    KnownModel model{
        .file = file, .box_size = outline.description.box_size, .reliefs = {}, .quality_levels = {}};
    TRY(model.reliefs, pack::reliefs_of(outline.description));
    for (std::uint32_t level = 0; level < outline.levels.size(); ++level) {
        const pack::LevelOutline& known = outline.levels[level];
        constexpr std::uint64_t per_vertex = sizeof(pack::PackVertex) + sizeof(glm::vec3);
        constexpr std::uint64_t per_triangle = 3 * sizeof(std::uint32_t) + 4 * sizeof(float);
        model.quality_levels.push_back(
            known_level_of({.level = level}, level, known.error, std::move(seen.levels[level]),
                           static_cast<double>(known.triangles),
                           known.vertices * per_vertex + known.triangles * per_triangle));
    }
    for (std::uint32_t k = 0; k < model.reliefs.size(); ++k) {
        const pack::ReliefOutline& known = model.reliefs[k];
        constexpr std::uint64_t more_in_memory = 2; // in memory a cell's corners are stored together
        model.quality_levels.push_back(known_level_of(
            {.level = known.texels, .relief = true}, k, known.error, std::move(seen.reliefs[k]),
            static_cast<double>(known.blocks), more_in_memory * known.bytes));
    }
    return model;
}

Result<ReadQualityLevel> read_quality_level(const KnownModel& model, std::size_t quality_level) {
    const KnownQualityLevel& known = model.quality_levels[quality_level];
    if (known.relief) {
        TRY(relief::BlockRelief relief, pack::load_relief(model.file, model.reliefs[known.number]));
        return read_relief(std::move(relief));
    }
    TRY(const pack::VerifiedPack pack, load_level(model, known.number));
    const scene::SceneLevel whole = scene::whole_level(*pack, known.number);
    const image::Image8& texture = pack->textures[whole.mesh.texture];
    ReadQualityLevel read{.data = scene::level_data(whole, texture),
                          .triangles = std::make_shared<const scene::LevelTriangles>(
                              scene::triangles_of(whole.mesh, pack->box_size))};
    read.bytes = scene::bytes_of(*read.triangles) + scene::gpu_bytes(whole, texture);
    return read;
}

Result<std::optional<scene::BoxCorners>> read_solid(const KnownModel& model) {
    std::optional<std::uint32_t> finest;
    for (const KnownQualityLevel& each : model.quality_levels) {
        finest = each.relief ? finest : each.number;
    }
    if (!finest || model.quality_levels[*finest].work > static_cast<double>(max_solid_triangles)) {
        return std::optional<scene::BoxCorners>();
    }
    TRY(const pack::VerifiedPack pack, load_level(model, *finest));
    const scene::SceneLevel whole = scene::whole_level(*pack, *finest);
    if (whole.cut_out) {
        return std::optional<scene::BoxCorners>();
    }
    const scene::LevelTriangles triangles = scene::triangles_of(whole.mesh, pack->box_size);
    return scene::inner_box(triangles.positions, triangles.indices);
}

} // namespace frustumscreen::residency
