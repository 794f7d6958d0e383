#include "app/show/offline_torch.h"

#include "app/image/light_mips.h"
#include "app/pack/pack_relief.h"
#include "app/pack/pack_world.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::show {

namespace {

Result<torch::Content> find_content(const pack::PackTorches& torches, const std::string& name) {
    if (name == torch::white_name) {
        return torch::white();
    }
    std::string names(torch::white_name);
    for (const pack::PackTorchContent& each : torches.contents) {
        if (each.content.name == name) {
            return each.content;
        }
        names += ", " + each.content.name;
    }
    return bad_input("render.no_torch", "--torch {}: the pack has no such content; it has {}", name, names);
}

/// The layer of one thing that is drawn. `file`: where its pack is a file of its own; otherwise it was read whole.
Result<void> add_layer(const std::filesystem::path* file, const pack::Pack& pack,
                       const scene::ScenePlan& plan, const std::shared_ptr<const relief::BlockRelief>& relief,
                       std::size_t number, OfflineTorch& torch) {
    TRY(const pack::PackTorches torches, pack::torches_of(pack));
    torch.textures.emplace_back();
    torch.colours.emplace_back();
    if (number >= torches.layers.size()) {
        return {};
    }
    const pack::PackLayer& layer = torches.layers[number];
    if (!relief) {
        const std::size_t texture = pack.levels[plan.quality_levels.front().level].texture;
        TRY(torch.textures.back(), file != nullptr ? pack::load_layer_texture(*file, layer, texture)
                                                   : pack::layer_texture_of(pack, layer, texture));
        return {};
    }
    TRY(const std::vector<pack::ReliefOutline> reliefs, pack::reliefs_of(pack));
    const auto which = std::find_if(reliefs.begin(), reliefs.end(), [&](const pack::ReliefOutline& each) {
        return each.texels == plan.reliefs.front().texels;
    });
    const auto index = static_cast<std::size_t>(which - reliefs.begin());
    TRY(std::vector<glm::u8vec4> colours,
        file != nullptr ? pack::load_layer_colours(*file, layer, index, relief->colours.size())
                        : pack::layer_colours_of(pack, layer, index, relief->colours.size()));
    torch.colours.back() = std::make_shared<const std::vector<glm::u8vec4>>(std::move(colours));
    return {};
}

Result<void> add_layers(const std::filesystem::path& file, const OfflineScene& scene, std::size_t number,
                        OfflineTorch& torch) {
    torch.layer = number;
    if (!scene.world) {
        return add_layer(&file, *scene.pack, scene.plan, scene.relief, number, torch);
    }
    TRY(const pack::PackWorld world, pack::load_world(file));
    for (const OfflineCell& cell : scene.world->drawn) {
        TRY(const pack::VerifiedPack whole, pack::load_cell(file, world.cells[cell.cell]));
        TRY_VOID(add_layer(nullptr, *whole, cell.plan, cell.relief, number, torch));
    }
    return {};
}

} // namespace

Result<OfflineTorch> load_offline_layer(const std::filesystem::path& file, const OfflineScene& scene,
                                        std::size_t layer) {
    OfflineTorch look;
    TRY_VOID(add_layers(file, scene, layer, look));
    return look;
}

Result<OfflineTorch> load_offline_torch(const std::filesystem::path& file, const OfflineScene& scene,
                                        const std::string& name) {
    TRY(const pack::PackTorches torches, pack::torches_of(*scene.pack));
    OfflineTorch torch;
    TRY(torch.content, find_content(torches, name));
    for (const torch::Stage& stage : torch.content.stages) {
        if (stage.source == torch::Source::Picture) {
            TRY(const image::Image8 picture, pack::load_torch_picture(file, torches.pictures[stage.item]));
            torch.picture = image::cut_out_mips(picture);
        } else if (stage.source == torch::Source::Film) {
            torch.film = torches.films[stage.item];
            TRY(torch.frames, pack::load_film(file, torch.film));
            TRY(const image::Image8 first, pack::film_frame_of(torch.film, torch.frames.front()));
            torch.picture = image::cut_out_mips(first);
        } else if (stage.source == torch::Source::Layer) {
            TRY_VOID(add_layers(file, scene, stage.item, torch));
        }
    }
    return torch;
}

} // namespace frustumscreen::show
