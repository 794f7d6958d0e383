#include "assets_baked/bake/loaders/obj_materials.h"

#include "assets_baked/bake/loaders/mtl_text.h"
#include "assets_baked/bake/loaders/source_about.h"
#include "assets_baked/bake/loaders/text.h"
#include "assets_baked/names/file_name.h"
#include "firmware_host/base/printable.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

namespace frustumscreen::bake {

namespace {

bool moves_picture(const tinyobj::texture_option_t& options) {
    return options.origin_offset[0] != 0 || options.origin_offset[1] != 0 || options.scale[0] != 1 ||
           options.scale[1] != 1;
}

bool changes_picture(const tinyobj::texture_option_t& options) {
    const tinyobj::real_t(&turbulence)[3] = options.turbulence;
    return options.brightness != 0 || options.contrast != 1 || turbulence[0] != 0 || turbulence[1] != 0 ||
           turbulence[2] != 0;
}

glm::vec4 colour_of(const tinyobj::real_t (&colour)[3]) {
    glm::vec4 made(1.0F);
    for (int i = 0; i < 3; ++i) {
        const auto factor = static_cast<float>(colour[i]);
        made[i] = factor >= 0.0F && factor <= 1.0F ? factor : 1.0F;
    }
    return made;
}

bool is_black(const glm::vec4& colour) {
    return glm::vec3(colour) == glm::vec3(0.0F);
}

constexpr int first_tile = 1001;
constexpr std::string_view first_tile_digits = "1001";
constexpr std::string_view tile_mark = "<UDIM>";

/// Where the name of a file has the number of the first tile, as a number of its own; npos if it has not.
std::size_t first_tile_in(std::string_view name) {
    const auto is_digit = [&](std::size_t k) { return k < name.size() && name[k] >= '0' && name[k] <= '9'; };
    const std::size_t begin = name.size() - last_part(name).size();
    const std::size_t found = name.rfind(first_tile_digits);
    const bool is_whole = found != std::string_view::npos && found >= begin &&
                          !(found > 0 && is_digit(found - 1)) && !is_digit(found + first_tile_digits.size());
    return is_whole ? found : std::string_view::npos;
}

bool may_be_tiled(const tinyobj::material_t& material) {
    const auto may = [](const std::string& name) {
        return name.find(tile_mark) != std::string::npos || first_tile_in(name) != std::string::npos;
    };
    return may(material.diffuse_texname) || may(material.emissive_texname);
}

/// The tile of a place in texture coordinates, v from the top; the first one for places that have no tile.
int tile_at(const glm::vec2& uv) {
    const float column = std::floor(uv.x);
    const float row = std::floor(1.0F - uv.y);
    const bool is_tile = column >= 0.0F && column < 10.0F && row >= 0.0F && row < 100.0F;
    return is_tile ? first_tile + static_cast<int>(column) + 10 * static_cast<int>(row) : first_tile;
}

/// The existing files that a line `mtllib` names: the whole line as one name, otherwise the longest runs of words that
/// are names.
std::vector<std::string> names_in(std::string_view line, const Sidecars& sidecars) {
    std::vector<std::string> words;
    WordReader reader(line);
    for (std::string_view word = reader.next(); !word.empty(); word = reader.next()) {
        words.emplace_back(word);
    }
    if (words.size() <= 1 || sidecars.exists(line)) {
        return {std::string(line)};
    }
    std::vector<std::string> names;
    for (std::size_t begin = 0; begin < words.size();) {
        std::size_t end = words.size();
        std::string name;
        for (; end > begin; --end) {
            name = fmt::format("{}", fmt::join(words.begin() + static_cast<std::ptrdiff_t>(begin),
                                               words.begin() + static_cast<std::ptrdiff_t>(end), " "));
            if (end == begin + 1 || sidecars.exists(name)) {
                break;
            }
        }
        names.push_back(name);
        begin = end;
    }
    return names;
}

} // namespace

void ObjMaterials::read_libraries(std::string_view names, const std::string& place) {
    for (const std::string& name : names_in(names, files_.sidecars)) {
        read_library(name, place);
    }
}

void ObjMaterials::read_library(const std::string& name, const std::string& place) {
    if (!files_.sidecars.exists(name)) {
        note_missing_library(name, place);
        return;
    }
    has_library_ = true;
    const std::shared_ptr<const Bytes> bytes = files_.sidecars.read(name, place);
    take_comments(as_text(*bytes), files_.about);
    const MtlText mtl = mtl_text_from(as_text(*bytes));
    std::istringstream stream{mtl.text};
    std::map<std::string, int> names;
    std::vector<tinyobj::material_t> materials;
    std::string warnings;
    std::string errors;
    tinyobj::LoadMtl(&names, &materials, &stream, &warnings, &errors);
    const std::string shown_name = printable(last_part(name));
    if (!mtl.unknown.empty()) {
        files_.notes.lost("lines of {} that the .mtl format does not have: {}", shown_name,
                          printable(fmt::format("{}", fmt::join(mtl.unknown, ", "))));
    }
    if (!mtl.lost.empty()) {
        files_.notes.lost("what lines of {} add to the picture: {}", shown_name,
                          printable(fmt::format("{}", fmt::join(mtl.lost, ", "))));
    }
    if (mtl.kd_in_codes) {
        files_.notes.guessed("the colours of {} are read as 0 to 255, because some are above 1", shown_name);
    }
    for (const auto& [material, index] : names) {
        if (!material.empty() && index >= 0 && static_cast<std::size_t>(index) < materials.size()) {
            tinyobj::material_t& source = materials[static_cast<std::size_t>(index)];
            for (tinyobj::real_t& part : source.diffuse) {
                part /= mtl.kd_in_codes ? 255 : 1;
            }
            take(material, source, files_.sidecars.folder_of(name));
        }
    }
}

void ObjMaterials::note_missing_library(std::string_view name, const std::string& place) {
    missing_library_ = true;
    if (!files_.pictures.has_curators()) { // the curator's own picture stands for the colours
        files_.notes.lost(
            "the colours: it names \"{}\" for them, but there is no such file beside it; put it there ({})",
            printable(last_part(name)), place);
    }
}

void ObjMaterials::take(const std::string& name, const tinyobj::material_t& source,
                        const std::filesystem::path& folder) {
    const Material& taken = known_.insert_or_assign(name, Material{source, folder}).first->second;
    for (const std::string* picture :
         {&source.diffuse_texname, &source.ambient_texname, &source.specular_texname,
          &source.specular_highlight_texname, &source.bump_texname, &source.displacement_texname,
          &source.alpha_texname, &source.reflection_texname, &source.roughness_texname,
          &source.metallic_texname, &source.sheen_texname, &source.emissive_texname,
          &source.normal_texname}) {
        if (!picture->empty()) {
            files_.sidecars.mention(picture_name(taken, *picture));
        }
    }
}

std::string ObjMaterials::picture_name(const Material& material, const std::string& name) const {
    const std::string beside_mtl = (material.folder / name).string();
    return !files_.sidecars.exists_as_written(name) && files_.sidecars.exists_as_written(beside_mtl)
               ? beside_mtl
               : name;
}

const ObjMaterials::Material* ObjMaterials::find(const std::string& name) {
    if (const auto known = known_.find(name); known != known_.end()) {
        return &known->second;
    }
    if (name.empty() && known_.size() == 1) {
        files_.notes.guessed("no face names a material; the only one, \"{}\", is taken",
                             printable(known_.begin()->first));
        return &known_.begin()->second;
    }
    const auto like = std::find_if(known_.begin(), known_.end(), [&](const auto& each) {
        return names::is_same_file_name(each.first, name);
    });
    return name.empty() || like == known_.end() ? nullptr : &like->second;
}

std::uint32_t ObjMaterials::number_of(const std::string& name, const glm::vec2& uv) {
    const auto [entry, is_new] = used_.try_emplace(name);
    Used& used = entry->second;
    const Material* const known = is_new || used.is_tiled ? find(name) : nullptr;
    if (is_new) {
        used.is_tiled = known != nullptr && may_be_tiled(known->source);
    }
    const int tile = used.is_tiled ? tile_at(uv) : first_tile;
    if (const auto made = used.number_of_tile.find(tile); made != used.number_of_tile.end()) {
        return made->second;
    }
    SourceMaterial made;
    if (known != nullptr) {
        made = made_from(*known, tile);
        note_unshown(*known);
    } else if (!name.empty()) {
        note_unknown(name);
    } else if (known_.size() > 1) {
        files_.notes.lost("the colours of faces that name no material: the file of materials (.mtl) has {}",
                          known_.size());
    }
    return used.number_of_tile[tile] = mesh_.add_material(made);
}

std::string ObjMaterials::picture_of_tile(const Material& material, const std::string& name, int tile) const {
    if (const std::size_t mark = name.find(tile_mark); mark != std::string::npos) {
        return std::string(name).replace(mark, tile_mark.size(), std::to_string(tile));
    }
    const std::size_t number = first_tile_in(name);
    if (tile == first_tile || number == std::string::npos) {
        return name;
    }
    std::string other = name;
    other.replace(number, first_tile_digits.size(), std::to_string(tile));
    return files_.sidecars.exists(picture_name(material, other)) ? other : name;
}

void ObjMaterials::note_unknown(const std::string& name) {
    if (has_library_) {
        files_.notes.lost("the colour of the material \"{}\": the file of materials (.mtl) does not have it",
                          printable(name));
    } else if (!missing_library_ && !files_.pictures.has_curators()) {
        files_.notes.lost("the colours: it names materials, but no file of materials (.mtl); export it again "
                          "with its materials");
    }
}

void ObjMaterials::note_unshown(const Material& material) {
    const tinyobj::material_t& source = material.source;
    const std::string name = printable(source.name);
    if (!source.normal_texname.empty() || !source.bump_texname.empty() ||
        !source.displacement_texname.empty()) {
        files_.notes.lost("the relief of the material \"{}\" that is drawn in a picture (bump, norm, disp), "
                          "not in triangles",
                          name);
    }
    if (!source.alpha_texname.empty()) {
        files_.notes.lost("the cut-outs of the material \"{}\" (map_d): it is shown whole", name);
    }
    if (source.dissolve < 1) {
        files_.notes.lost("the transparency of the material \"{}\" (d {:.2f}): it is shown opaque", name,
                          source.dissolve);
    }
    if (changes_picture(source.diffuse_texopt)) {
        files_.notes.lost(
            "how the picture of the material \"{}\" is changed (map_Kd -mm, -t): it is shown as it is", name);
    }
    if (moves_picture(source.diffuse_texopt)) {
        files_.notes.lost("where the picture of the material \"{}\" lies (map_Kd -o, -s): it is shown as if "
                          "both were left out",
                          name);
    }
}

SourceMaterial ObjMaterials::made_from(const Material& material, int tile) {
    const tinyobj::material_t& source = material.source;
    SourceMaterial made;
    made.base_colour = colour_of(source.diffuse);
    const bool has_picture = !source.diffuse_texname.empty();
    if (has_picture) {
        made.texture = texture(material, picture_of_tile(material, source.diffuse_texname, tile),
                               source.diffuse_texopt, "map_Kd");
        if (is_black(
                made.base_colour)) { // some exporters write a black Kd beside a picture and mean the picture alone
            made.base_colour = glm::vec4(1.0F);
        }
    }
    const glm::vec4 emission = colour_of(source.emission);
    const bool glows = !source.emissive_texname.empty() || !is_black(emission);
    if (!glows) {
        return made;
    }
    const std::string name = printable(source.name);
    if (has_picture || (!is_black(made.base_colour) && source.emissive_texname.empty())) {
        files_.notes.lost("the own light of the material \"{}\" (Ke, map_Ke)", name);
        return made;
    }
    files_.notes.guessed(
        "the material \"{}\" has no colour; its own light (Ke, map_Ke) is used as the colour", name);
    made.base_colour = is_black(emission) ? glm::vec4(1.0F) : emission;
    made.has_own_light = true;
    if (!source.emissive_texname.empty()) {
        made.texture = texture(material, picture_of_tile(material, source.emissive_texname, tile),
                               source.emissive_texopt, "map_Ke");
    }
    return made;
}

int ObjMaterials::texture(const Material& material, const std::string& name,
                          const tinyobj::texture_option_t& options, std::string_view keyword) {
    const std::string found = picture_name(material, name);
    std::shared_ptr<const image::Image8>& picture = pictures_by_name_[found];
    if (!picture) {
        picture = files_.pictures.named(found, fmt::format("{} {}", keyword, printable(name)));
    }
    const Wrap wrap = options.clamp ? Wrap::Clamp : Wrap::Repeat;
    return mesh_.add_texture({picture, wrap, wrap});
}

} // namespace frustumscreen::bake
