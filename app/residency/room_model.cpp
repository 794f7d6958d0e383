#include "app/residency/room_model.h"

#include "app/pack/pack_relief.h"
#include "app/scene/scene_plan.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::residency {

Result<ReadModel> read_model(const std::filesystem::path& file) {
    TRY(pack::VerifiedPack pack, pack::load_pack(file));
    TRY(scene::SeenByEyes seen, scene::seen_by_eyes(pack::outline_of(*pack)));
    TRY(const std::vector<pack::ReliefOutline> reliefs, pack::reliefs_of(*pack));
    ReadModel read{.pack = std::move(pack), .seen = std::move(seen), .reliefs = {}};
    for (const pack::ReliefOutline& each : reliefs) {
        TRY(relief::BlockRelief relief, pack::relief_of(*read.pack, each));
        read.reliefs.push_back(std::make_shared<const relief::BlockRelief>(std::move(relief)));
    }
    return read;
}

std::size_t RoomModel::max_indices() const {
    std::size_t most = 0;
    for (const ModelWay& way : ways) {
        most = std::max(most, way.placed.triangles ? way.placed.triangles->indices.size() : 0);
    }
    return most;
}

Result<RoomModel> upload(const ReadModel& read, render::GpuStore& store) {
    const pack::Pack& pack = *read.pack;
    RoomModel model{.box_size = pack.box_size, .ways = {}};
    const auto add = [&](scene::PlacedLevel placed, const scene::QualityLevel& shows,
                         const scene::SeenLevel& seen, double work) {
        model.ways.push_back({.name = scene::name_of(shows),
                              .placed = std::move(placed),
                              .seen = seen,
                              .mean_box = double{scene::worst_of(seen).mean_box},
                              .work = work});
    };
    for (std::uint32_t level = 0; level < pack.levels.size(); ++level) {
        const scene::SceneLevel whole = scene::whole_level(pack, level);
        TRY(const scene::Drawable drawable, store.upload(whole, pack.textures[whole.mesh.texture]));
        add(scene::placed(pack, level, 1.0, drawable), {.level = level}, read.seen.levels[level],
            static_cast<double>(whole.mesh.indices.size() / 3));
    }
    for (std::size_t k = 0; k < read.reliefs.size(); ++k) {
        const scene::Drawable drawable = store.keep(read.reliefs[k]);
        const auto texels = static_cast<std::uint32_t>(1.0F / read.reliefs[k]->texel_box + 0.5F);
        add(scene::placed(pack, read.reliefs[k], 1.0, drawable), {.level = texels, .relief = true},
            read.seen.reliefs[k], static_cast<double>(read.reliefs[k]->blocks.size()));
    }
    return model;
}

scene::RenderNeeds needs_of_room(int samples) {
    scene::RenderNeeds needs{.samples = samples, .draws = {scene::raster_shader()}, .rasterizes = true};
    for (const bool cut_out : {false, true}) {
        for (const bool dithered : {false, true}) {
            needs.draws.insert({.cut_out = cut_out, .dithered = dithered});
        }
    }
    needs.interlocks = true;
    return needs;
}

} // namespace frustumscreen::residency
