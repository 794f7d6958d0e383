#include "app/pack/binary_parts.h"
#include "app/pack/check_pack.h"
#include "app/pack/container/limits.h"
#include "app/pack/container/sha256.h"
#include "app/pack/container/zip_archive.h"
#include "app/pack/manifest.h"
#include "app/pack/pack_file.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <set>

namespace frustumscreen::pack {

namespace {

/// A part to be written to the container. Pictures are already packed.
struct Part {
    std::string name;
    Bytes bytes;
    Packing packing = Packing::Stored;
};

Result<void> check(const Pack& pack) {
    return check_description(pack).and_then([&] { return check_pictures(pack); }).and_then([&] {
        return check_levels(pack);
    });
}

/// As PNG or WebP, whichever is smaller; `name` is without the ending.
Part picture_part(const std::string& name, const image::Image8& picture) {
    Bytes png = image::encode_png(picture);
    Bytes webp = image::encode_webp(picture);
    const bool is_webp = !webp.empty() && webp.size() < png.size();
    return {name + (is_webp ? ".webp" : ".png"), std::move(is_webp ? webp : png), Packing::Stored};
}

void add_textures(const Pack& pack, Manifest& manifest, std::vector<Part>& parts) {
    for (std::size_t k = 0; k < pack.textures.size(); ++k) {
        parts.push_back(picture_part(fmt::format("textures/{}", k), pack.textures[k]));
        manifest.textures.push_back(parts.back().name);
    }
}

/// The table picture comes first, so that reading it alone reads little of the file.
void add_table_picture(const Pack& pack, Manifest& manifest, std::vector<Part>& parts) {
    if (!pack.table_picture.texels.empty()) {
        parts.push_back(picture_part("table_picture", pack.table_picture));
        manifest.table_picture = parts.back().name;
    }
}

/// Sounds and pictures are already packed and would not get smaller.
Packing packing_of(const std::string& section_part) {
    return section_part.ends_with(".bin") ? Packing::Deflated : Packing::Stored;
}

Result<void> add_section_parts(const Pack& pack, std::vector<Part>& parts) {
    for (const PackSection& section : pack.sections) {
        for (const std::string& name : section.parts) {
            const auto bytes = pack.section_parts.find(name);
            if (!is_part_name(name) || bytes == pack.section_parts.end()) {
                return bad_input(
                    "pack.section_part",
                    "the section {} names the part '{}', which is missing or is not a valid name",
                    section.name, printable(name, 40));
            }
            parts.push_back({name, bytes->second, packing_of(name)});
        }
    }
    return {};
}

void add_relief(const Pack& pack, Manifest& manifest, std::vector<Part>& parts) {
    if (pack.relief.charts.empty()) {
        return;
    }
    manifest.relief = ReliefRecord{pack.relief.texel_box, "relief/atlas.png", "relief/charts.bin"};
    parts.push_back({manifest.relief->atlas, image::encode_png(pack.relief.relief), Packing::Stored});
    parts.push_back({manifest.relief->charts, encode_charts(pack.relief.charts), Packing::Deflated});
}

Result<void> add_levels(const Pack& pack, Manifest& manifest, std::vector<Part>& parts) {
    for (std::size_t k = 0; k < pack.levels.size(); ++k) {
        const PackLevel& level = pack.levels[k];
        TRY(Bytes bytes, at(fmt::format("level {}", k), encode_level(level, pack.relief, pack.box_size)));
        const std::string name = fmt::format("levels/{}.bin", k);
        manifest.levels.push_back(
            {{level.technique, level.error, level.indices.size() / 3, level.vertices.size(), level.texture},
             name});
        parts.push_back({name, std::move(bytes), Packing::Deflated});
    }
    return {};
}

Result<void> list_parts(const std::vector<Part>& parts, Manifest& manifest) {
    std::uint64_t together = 0;
    std::set<std::string_view> names;
    for (const Part& part : parts) {
        if (!names.insert(part.name).second) {
            return bad_input("pack.parts_of_one_name", "two parts are called {}; give them different names",
                             part.name);
        }
        together += part.bytes.size();
        if (part.bytes.empty() || part.bytes.size() > max_part_bytes || together > max_parts_bytes) {
            return bad_input("pack.part_too_large",
                             "{} has {} bytes; allowed are 1 to {}, and {} for all parts", part.name,
                             part.bytes.size(), max_part_bytes, max_parts_bytes);
        }
        manifest.parts.push_back({part.name, part.bytes.size(), sha256_hex(part.bytes)});
    }
    return {};
}

} // namespace

Result<Bytes> write_pack(const Pack& pack) {
    TRY_VOID(check(pack));
    Manifest manifest;
    manifest.description = pack;
    std::vector<Part> parts;
    add_table_picture(pack, manifest, parts);
    add_textures(pack, manifest, parts);
    add_relief(pack, manifest, parts);
    TRY_VOID(add_levels(pack, manifest, parts).and_then([&] { return add_section_parts(pack, parts); }));
    TRY_VOID(list_parts(parts, manifest));
    const std::string text = write_manifest(manifest);
    if (text.size() > max_manifest_bytes) {
        return bad_input("pack.manifest_too_long",
                         "the manifest has {} bytes, allowed are {}; give fewer or shorter texts",
                         text.size(), max_manifest_bytes);
    }
    ZipWriter zip;
    zip.add(std::string(manifest_name), as_bytes(text), Packing::Deflated);
    for (const Part& part : parts) {
        zip.add(part.name, part.bytes, part.packing);
    }
    return zip.finish();
}

} // namespace frustumscreen::pack
