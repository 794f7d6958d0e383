#include "app/residency/thrown_layer.h"

#include "app/pack/pack_relief.h"

#include <utility>

namespace frustumscreen::residency {

namespace {

constexpr std::size_t corners_per_block = std::size_t{relief::block_corners} * relief::block_corners;

/// A layer of the cell's own pack, which is read whole.
Result<ReadLayer> read_cell_layer(const std::filesystem::path& file, const pack::PackCell& cell,
                                  const pack::PackOutline& outline, std::size_t number) {
    TRY(const pack::VerifiedPack pack, pack::load_cell(file, cell));
    TRY(const pack::PackTorches torches, pack::torches_of(*pack));
    TRY(const std::vector<pack::ReliefOutline> reliefs, pack::reliefs_of(*pack));
    ReadLayer layer{.layer = number, .textures = {}, .reliefs = {}};
    if (number >= torches.layers.size()) {
        return layer;
    }
    const pack::PackLayer& packed = torches.layers[number];
    for (std::size_t k = 0; k < packed.textures.size(); ++k) {
        TRY(image::Image8 texture, pack::layer_texture_of(*pack, packed, k));
        layer.textures.push_back(std::move(texture));
    }
    for (std::size_t k = 0; k < packed.reliefs.size(); ++k) {
        TRY(std::vector<glm::u8vec4> colours,
            pack::layer_colours_of(*pack, packed, k, corners_per_block * reliefs.at(k).blocks));
        layer.reliefs.push_back(std::make_shared<const std::vector<glm::u8vec4>>(std::move(colours)));
        layer.relief_texels.push_back(reliefs.at(k).texels);
    }
    for (const pack::LevelOutline& level : outline.levels) {
        layer.texture_of_level.push_back(level.texture);
    }
    return layer;
}

} // namespace

Result<std::vector<ThrownContents>> thrown_contents(std::span<const KnownArtifact> artifacts) {
    std::vector<ThrownContents> all;
    for (const KnownArtifact& known : artifacts) {
        const pack::PackDescription& pack = known.outline.description;
        TRY(pack::PackTorches torches, at(known.file.string(), pack::torches_of(pack)));
        TRY(const std::vector<pack::ReliefOutline> reliefs, at(known.file.string(), pack::reliefs_of(pack)));
        ThrownContents& thrown = all.emplace_back();
        thrown.file = known.file;
        thrown.torches = std::move(torches);
        thrown.world = known.world;
        for (const pack::LevelOutline& level : known.outline.levels) {
            thrown.texture_of_level.push_back(level.texture);
        }
        for (const pack::ReliefOutline& relief : reliefs) {
            thrown.relief_texels.push_back(relief.texels);
            thrown.relief_corners.push_back(corners_per_block * relief.blocks);
        }
    }
    return all;
}

Result<ReadLayer> read_layer(const ThrownContents& thrown, std::size_t number) {
    const std::filesystem::path& file = thrown.file;
    const pack::PackTorches& torches = thrown.torches;
    const pack::PackLayer& packed = torches.layers[number];
    ReadLayer layer{.layer = number,
                    .textures = {},
                    .reliefs = {},
                    .texture_of_level = thrown.texture_of_level,
                    .relief_texels = thrown.relief_texels};
    for (std::size_t k = 0; k < packed.textures.size(); ++k) {
        TRY(image::Image8 texture, pack::load_layer_texture(file, packed, k));
        layer.textures.push_back(std::move(texture));
    }
    for (std::size_t k = 0; k < packed.reliefs.size(); ++k) {
        TRY(std::vector<glm::u8vec4> colours,
            pack::load_layer_colours(file, packed, k, thrown.relief_corners.at(k)));
        layer.reliefs.push_back(std::make_shared<const std::vector<glm::u8vec4>>(std::move(colours)));
    }
    const std::size_t cells = thrown.world ? thrown.world->drawn.size() : 0;
    for (std::size_t k = 0; k < cells; ++k) {
        const KnownCell& drawn = thrown.world->drawn[k];
        TRY(ReadLayer cell,
            read_cell_layer(file, thrown.world->world.cells[drawn.cell], drawn.outline, number));
        layer.cells.push_back(std::move(cell));
    }
    return layer;
}

} // namespace frustumscreen::residency
