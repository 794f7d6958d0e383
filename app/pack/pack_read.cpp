#include "app/pack/binary_parts.h"
#include "app/pack/check_pack.h"
#include "app/pack/container/limits.h"
#include "app/pack/pack_file.h"
#include "app/pack/pack_reader.h"
#include "app/pack/picture_part.h"

#include <fmt/format.h>

namespace frustumscreen::pack {

namespace {

/// The levels to read, and what they need.
struct Chosen {
    std::vector<bool> levels;
    std::vector<bool> textures;
    bool relief = false;
};

Chosen everything(const Manifest& manifest) {
    return {std::vector<bool>(manifest.levels.size(), true),
            std::vector<bool>(manifest.textures.size(), true), true};
}

Result<Chosen> chosen_by(const ChooseLevels& choose, const Manifest& manifest) {
    const PackOutline outline{manifest.description, {manifest.levels.begin(), manifest.levels.end()}};
    Chosen chosen{std::vector<bool>(manifest.levels.size()), std::vector<bool>(manifest.textures.size())};
    TRY(const std::vector<std::uint32_t> levels, choose(outline));
    for (const std::uint32_t level : levels) {
        const LevelRecord& record = manifest.levels.at(level);
        chosen.levels[level] = true;
        chosen.textures[record.texture] = true;
        chosen.relief = chosen.relief || record.technique == LevelTechnique::Relief;
    }
    return chosen;
}

Result<void> read_textures(PackReader& reader, const Chosen& chosen, Pack& pack) {
    std::int64_t left = max_texels_together;
    for (const std::string& name : reader.manifest().textures) {
        if (!chosen.textures[pack.textures.size()]) {
            TRY_VOID(reader.skip(name));
            pack.textures.emplace_back();
            continue;
        }
        TRY(image::Image8 texture, read_picture(reader, name, std::min(max_texels, left)));
        left -= static_cast<std::int64_t>(texture.texels.size());
        pack.textures.push_back(std::move(texture));
    }
    return {};
}

Result<void> read_relief(PackReader& reader, const Chosen& chosen, Pack& pack) {
    const std::optional<ReliefRecord>& record = reader.manifest().relief;
    if (!record) {
        return {};
    }
    if (!chosen.relief) {
        return reader.skip(record->atlas).and_then([&] { return reader.skip(record->charts); });
    }
    TRY(const Bytes atlas, reader.take(record->atlas));
    TRY(image::Image16 relief, at(record->atlas, image::decode_png16(atlas, max_texels)));
    TRY(const Bytes charts_bytes, reader.take(record->charts));
    TRY(std::vector<ReliefChart> charts, at(record->charts, decode_charts(charts_bytes)));
    pack.relief = {record->texel_box, std::move(charts), std::move(relief)};
    return {};
}

Result<PackLevel> read_level(PackReader& reader, const LevelRecord& record, const Pack& pack) {
    TRY(const Bytes bytes, reader.take(record.mesh));
    TRY(PackLevel level, at(record.mesh, decode_level(bytes, pack.relief, pack.box_size)));
    if (level.technique != record.technique || level.vertices.size() != record.vertices ||
        level.indices.size() != record.triangles * 3) {
        return bad_input("pack.other_triangles",
                         "{} holds other triangles than the manifest says; the pack is altered", record.mesh);
    }
    level.error = record.error;
    level.texture = record.texture;
    return level;
}

Result<void> read_levels(PackReader& reader, const Chosen& chosen, Pack& pack) {
    for (const LevelRecord& record : reader.manifest().levels) {
        if (!chosen.levels[pack.levels.size()]) {
            TRY_VOID(reader.skip(record.mesh));
            pack.levels.push_back({.technique = record.technique,
                                   .error = record.error,
                                   .texture = record.texture,
                                   .vertices = {},
                                   .indices = {},
                                   .clusters = {}});
            continue;
        }
        TRY(PackLevel level, read_level(reader, record, pack));
        if (level.indices.empty()) { // an empty level would count as not read
            return at(record.mesh, check_mesh(level).error());
        }
        pack.levels.push_back(std::move(level));
    }
    return {};
}

/// With chosen levels, neither the table's picture nor a section's part is read.
Result<void> read_extras(PackReader& reader, Read read, Pack& pack) {
    if (read == Read::All) {
        TRY(pack.table_picture, read_table_picture(reader));
    } else if (!reader.manifest().table_picture.empty()) {
        TRY_VOID(reader.skip(reader.manifest().table_picture));
    }
    for (const PackSection& section : pack.sections) {
        for (const std::string& name : section.parts) {
            if (read == Read::Chosen) {
                TRY_VOID(reader.skip(name));
                continue;
            }
            TRY(Bytes bytes, reader.take(name));
            pack.section_parts.emplace(name, std::move(bytes));
        }
    }
    return {};
}

/// Each step requires that the steps before it succeeded.
Result<void> read_all(PackReader& reader, const ChooseLevels& choose, Pack& pack) {
    TRY_VOID(check_description(pack));
    TRY_VOID(check_level_count(pack, reader.manifest().levels.size()));
    TRY(const Chosen chosen, choose ? chosen_by(choose, reader.manifest()) : everything(reader.manifest()));
    const Read read = choose ? Read::Chosen : Read::All;
    return read_textures(reader, chosen, pack)
        .and_then([&] { return read_relief(reader, chosen, pack); })
        .and_then([&] { return check_pictures(pack, read); })
        .and_then([&] { return read_levels(reader, chosen, pack); })
        .and_then([&] { return check_levels(pack, read); })
        .and_then([&] { return read_extras(reader, read, pack); })
        .and_then([&] { return reader.finish(); });
}

} // namespace

PackOutline outline_of(const Pack& pack) {
    PackOutline outline{pack, {}};
    for (const PackLevel& level : pack.levels) {
        outline.levels.push_back({.technique = level.technique,
                                  .error = level.error,
                                  .triangles = level.indices.size() / 3,
                                  .vertices = level.vertices.size(),
                                  .texture = level.texture});
    }
    return outline;
}

Result<VerifiedPack> read_pack(PackReader& reader, const ChooseLevels& choose) {
    VerifiedPack read;
    read.pack_ = Pack{reader.manifest().description, {}, {}, {}, {}, {}};
    TRY_VOID(read_all(reader, choose, read.pack_));
    return read;
}

Result<VerifiedPack> verify_pack(std::span<const std::byte> bytes, const ChooseLevels& choose) {
    TRY(PackReader reader, PackReader::open(bytes));
    return read_pack(reader, choose);
}

Result<VerifiedPack> load_pack(const std::filesystem::path& file, const ChooseLevels& choose) {
    TRY(PackReader reader, open_pack_file(file));
    return at(file.string(), read_pack(reader, choose));
}

} // namespace frustumscreen::pack
