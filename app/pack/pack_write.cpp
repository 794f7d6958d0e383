#include "app/pack/binary_parts.h"
#include "app/pack/check_pack.h"
#include "app/pack/limits.h"
#include "app/pack/manifest.h"
#include "app/pack/pack_file.h"
#include "app/pack/sha256.h"
#include "app/pack/zip_archive.h"

#include <fmt/format.h>

namespace frustumscreen {

using namespace pack_format;

namespace {

/// A part on its way into the container. Pictures are packed already.
struct Part {
    std::string name;
    Bytes bytes;
    Packing packing = Packing::Stored;
};

Result<void> check(const Pack& pack) {
    return check_texts(pack)
        .and_then([&] { return check_placement(pack); })
        .and_then([&] { return check_pictures(pack); })
        .and_then([&] { return check_levels(pack); });
}

/// As PNG or WebP, whichever is smaller.
void add_textures(const Pack& pack, Manifest& manifest, std::vector<Part>& parts) {
    for (std::size_t k = 0; k < pack.textures.size(); ++k) {
        Bytes png = encode_png(pack.textures[k]);
        Bytes webp = encode_webp(pack.textures[k]);
        const bool is_webp = !webp.empty() && webp.size() < png.size();
        manifest.textures.push_back(fmt::format("textures/{}.{}", k, is_webp ? "webp" : "png"));
        parts.push_back({manifest.textures.back(), std::move(is_webp ? webp : png), Packing::Stored});
    }
}

void add_relief(const Pack& pack, Manifest& manifest, std::vector<Part>& parts) {
    if (pack.relief.charts.empty()) {
        return;
    }
    manifest.relief = ReliefRecord{pack.relief.texel_box, "relief/atlas.png", "relief/charts.bin"};
    parts.push_back({manifest.relief->atlas, encode_png(pack.relief.relief), Packing::Stored});
    parts.push_back({manifest.relief->charts, encode_charts(pack.relief.charts), Packing::Deflated});
}

Result<void> add_levels(const Pack& pack, Manifest& manifest, std::vector<Part>& parts) {
    for (std::size_t k = 0; k < pack.levels.size(); ++k) {
        const PackLevel& level = pack.levels[k];
        Result<Bytes> bytes = encode_level(level, pack.relief, pack.box_size);
        if (!bytes) {
            return at(fmt::format("level {}", k), bytes.error());
        }
        const std::string name = fmt::format("levels/{}.bin", k);
        manifest.levels.push_back(
            {{level.technique, level.error, level.indices.size() / 3, level.vertices.size(), level.texture},
             name});
        parts.push_back({name, std::move(*bytes), Packing::Deflated});
    }
    return {};
}

Result<void> list_parts(const std::vector<Part>& parts, Manifest& manifest) {
    std::uint64_t together = 0;
    for (const Part& part : parts) {
        together += part.bytes.size();
        if (part.bytes.empty() || part.bytes.size() > most_part_bytes || together > most_parts_bytes) {
            return bad_input(
                fmt::format("{} has {} bytes; allowed are 1 to {}, and {} for all parts together", part.name,
                            part.bytes.size(), most_part_bytes, most_parts_bytes));
        }
        manifest.parts.push_back({part.name, part.bytes.size(), sha256_hex(part.bytes)});
    }
    return {};
}

} // namespace

Result<Bytes> write_pack(const Pack& pack) {
    if (auto good = check(pack); !good) {
        return tl::unexpected(good.error());
    }
    Manifest manifest;
    manifest.description = pack;
    std::vector<Part> parts;
    add_textures(pack, manifest, parts);
    add_relief(pack, manifest, parts);
    if (auto good = add_levels(pack, manifest, parts); !good) {
        return tl::unexpected(good.error());
    }
    if (auto good = list_parts(parts, manifest); !good) {
        return tl::unexpected(good.error());
    }
    const std::string text = write_manifest(manifest);
    if (text.size() > most_manifest_bytes) {
        return bad_input(fmt::format("the manifest has {} bytes, allowed are {}; give fewer or shorter texts",
                                     text.size(), most_manifest_bytes));
    }
    ZipWriter zip;
    zip.add(std::string(manifest_name), as_bytes(text), Packing::Deflated);
    for (const Part& part : parts) {
        zip.add(part.name, part.bytes, part.packing);
    }
    return zip.finish();
}

} // namespace frustumscreen
