#include "app/pack/pack_torches.h"

#include "app/image/film_frame.h"
#include "app/pack/colours_part.h"
#include "app/pack/container/limits.h"
#include "app/pack/pack_relief.h"
#include "app/pack/pack_sections.h"
#include "app/pack/torch_sections.h"
#include "app/pack/world_sections.h"
#include "app/relief/block_relief.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <map>
#include <utility>

namespace frustumscreen::pack {

namespace {

constexpr std::size_t corners_per_block = std::size_t{relief::block_corners} * relief::block_corners;

/// Some part of the section, of the file as it is now.
Result<Bytes> load_part(const std::filesystem::path& file, const std::string& part) {
    TRY(auto parts, load_section_parts(file, [&](const PackDescription&) -> Result<std::vector<std::string>> {
            return std::vector{part};
        }));
    return std::move(parts.at(part));
}

Result<image::Image8> decode_layer_texture(std::span<const std::byte> bytes) {
    return image::decode_webp8(bytes, max_texels);
}

Result<void> check_relief_count(const PackTorches& torches, const PackDescription& pack) {
    TRY(const std::vector<ReliefOutline> reliefs, reliefs_of(pack));
    for (const PackLayer& layer : torches.layers) {
        if (layer.reliefs.size() != reliefs.size()) {
            return bad_input(
                "torches.reliefs",
                "the layer '{}' has colours for {} reliefs, the pack has {}; bake the pack again",
                printable(layer.name, 40), layer.reliefs.size(), reliefs.size());
        }
    }
    return {};
}

Result<void> check_layer(const Pack& pack, const PackLayer& layer,
                         const std::vector<ReliefOutline>& reliefs) {
    if (layer.textures.size() != pack.textures.size()) {
        return bad_input("torches.textures",
                         "the layer '{}' has {} textures, the pack has {}; bake the pack again",
                         printable(layer.name, 40), layer.textures.size(), pack.textures.size());
    }
    for (std::size_t k = 0; k < layer.textures.size(); ++k) {
        const image::Image8& texture = pack.textures[k];
        TRY(const image::PictureExtent extent,
            at(layer.textures[k], image::extent_of_webp(pack.section_parts.at(layer.textures[k]))));
        if (extent.width != texture.width || extent.height != texture.height) {
            return bad_input(
                "torches.texture_size",
                "{}: it has {} x {} texels, the texture in whose place it is shown {} x {}; bake "
                "the pack again",
                layer.textures[k], extent.width, extent.height, texture.width, texture.height);
        }
        TRY_VOID(without_value(layer_texture_of(pack, layer, k)));
    }
    for (std::size_t k = 0; k < reliefs.size(); ++k) {
        TRY_VOID(without_value(layer_colours_of(pack, layer, k, corners_per_block * reliefs[k].blocks)));
    }
    return {};
}

/// Adds a part to the section and the pack, and gives back its name.
std::string add_part(Pack& pack, PackSection& section, std::string name, Bytes bytes) {
    section.parts.push_back(name);
    pack.section_parts[name] = std::move(bytes);
    return name;
}

void add_layer(Pack& pack, PackSection& section, std::size_t number, TorchParts::Layer bytes,
               const std::vector<ReliefOutline>& reliefs, PackLayer& layer) {
    for (std::size_t k = 0; k < bytes.textures.size(); ++k) {
        layer.textures.push_back(add_part(pack, section, fmt::format("torches/layer_{}/{}.webp", number, k),
                                          std::move(bytes.textures[k])));
    }
    for (std::size_t k = 0; k < bytes.reliefs.size(); ++k) {
        const std::string name =
            fmt::format("torches/layer_{}/relief_{}.bin", number, k < reliefs.size() ? reliefs[k].texels : 0);
        layer.reliefs.push_back(add_part(pack, section, name, std::move(bytes.reliefs[k])));
    }
}

} // namespace

Result<PackTorches> torches_of(const PackDescription& pack) {
    TRY(PackTorches torches, read_torch_section(pack));
    TRY_VOID(check_torch_fields(torches));
    TRY_VOID(check_relief_count(torches, pack));
    return torches;
}

Result<void> put_torches(Pack& pack, PackTorches torches, TorchParts parts) {
    assert(find_section(pack, torches_section) == nullptr);
    assert(parts.pictures.size() == torches.pictures.size() && parts.films.size() == torches.films.size() &&
           parts.layers.size() == torches.layers.size());
    if (torches.empty()) {
        return {};
    }
    TRY(const std::vector<ReliefOutline> reliefs, reliefs_of(pack));
    PackSection section{std::string(torches_section), {}, {}};
    for (std::size_t k = 0; k < parts.pictures.size(); ++k) {
        torches.pictures[k].part =
            add_part(pack, section, fmt::format("torches/picture_{}.webp", k), std::move(parts.pictures[k]));
    }
    for (std::size_t k = 0; k < parts.films.size(); ++k) {
        torches.films[k].frames = static_cast<std::uint32_t>(parts.films[k].size());
        torches.films[k].parts.clear();
        for (std::size_t frame = 0; frame < parts.films[k].size(); ++frame) {
            torches.films[k].parts.push_back(add_part(pack, section,
                                                      fmt::format("torches/film_{}/{:05}.webp", k, frame),
                                                      std::move(parts.films[k][frame])));
        }
    }
    for (std::size_t k = 0; k < parts.layers.size(); ++k) {
        torches.layers[k].textures.clear();
        torches.layers[k].reliefs.clear();
        add_layer(pack, section, k, std::move(parts.layers[k]), reliefs, torches.layers[k]);
    }
    section.data = write_torches(torches);
    pack.sections.push_back(std::move(section));
    return without_value(torches_of(pack));
}

Result<image::Image8> load_torch_picture(const std::filesystem::path& file, const PackTorchPicture& picture) {
    TRY(const Bytes bytes, load_part(file, picture.part));
    return at(file.string(), at(picture.part, image::decode_still(bytes, {picture.width, picture.height})));
}

Result<image::Image8> load_film_frame(const std::filesystem::path& file, const PackFilm& film,
                                      std::uint32_t frame) {
    TRY(const Bytes bytes, load_part(file, film.parts.at(frame)));
    return at(file.string(), at(film.parts[frame], film_frame_of(film, bytes)));
}

Result<std::vector<Bytes>> load_film(const std::filesystem::path& file, const PackFilm& film) {
    TRY(auto parts, load_section_parts(file, [&](const PackDescription&) -> Result<std::vector<std::string>> {
            return film.parts;
        }));
    std::vector<Bytes> frames;
    for (const std::string& part : film.parts) {
        frames.push_back(std::move(parts.at(part)));
    }
    return frames;
}

Result<image::Image8> film_frame_of(const PackFilm& film, std::span<const std::byte> frame) {
    return image::decode_still(frame, {film.width, film.height});
}

Result<image::Image8> load_layer_texture(const std::filesystem::path& file, const PackLayer& layer,
                                         std::size_t texture) {
    TRY(const Bytes bytes, load_part(file, layer.textures.at(texture)));
    return at(file.string(), at(layer.textures[texture], decode_layer_texture(bytes)));
}

Result<std::vector<glm::u8vec4>> load_layer_colours(const std::filesystem::path& file, const PackLayer& layer,
                                                    std::size_t relief, std::size_t corners) {
    TRY(const Bytes bytes, load_part(file, layer.reliefs.at(relief)));
    return at(file.string(), at(layer.reliefs[relief], decode_colours(bytes, corners)));
}

Result<image::Image8> layer_texture_of(const Pack& pack, const PackLayer& layer, std::size_t texture) {
    const std::string& part = layer.textures.at(texture);
    return at(part, decode_layer_texture(pack.section_parts.at(part)));
}

Result<std::vector<glm::u8vec4>> layer_colours_of(const Pack& pack, const PackLayer& layer,
                                                  std::size_t relief, std::size_t corners) {
    const std::string& part = layer.reliefs.at(relief);
    return at(part, decode_colours(pack.section_parts.at(part), corners));
}

Result<void> check_torches(const Pack& pack) {
    TRY(const PackTorches torches, torches_of(pack));
    for (const PackTorchPicture& picture : torches.pictures) {
        TRY_VOID(without_value(at(picture.part, image::decode_still(pack.section_parts.at(picture.part),
                                                                    {picture.width, picture.height}))));
    }
    for (const PackFilm& film : torches.films) {
        for (const std::string& part : film.parts) {
            TRY_VOID(without_value(at(part, film_frame_of(film, pack.section_parts.at(part)))));
        }
    }
    TRY(const std::vector<ReliefOutline> reliefs, reliefs_of(pack));
    for (const PackLayer& layer : torches.layers) {
        TRY_VOID(check_layer(pack, layer, reliefs));
    }
    return {};
}

} // namespace frustumscreen::pack
