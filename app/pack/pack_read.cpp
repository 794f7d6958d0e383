#include "app/pack/binary_parts.h"
#include "app/pack/check_pack.h"
#include "app/pack/limits.h"
#include "app/pack/pack_file.h"
#include "app/pack/pack_reader.h"

#include <fmt/format.h>

namespace frustumscreen {

using namespace pack_format;

namespace {

Result<void> read_textures(PackReader& reader, Pack& pack) {
    std::int64_t left = most_texels_together;
    for (const std::string& name : reader.manifest().textures) {
        const Result<Bytes> bytes = reader.take(name);
        if (!bytes) {
            return tl::unexpected(bytes.error());
        }
        Result<Image8> texture = decode_png8(*bytes, std::min(most_texels, left));
        if (!texture) {
            return at(name, texture.error());
        }
        left -= static_cast<std::int64_t>(texture->texels.size());
        pack.textures.push_back(std::move(*texture));
    }
    return {};
}

Result<void> read_relief(PackReader& reader, Pack& pack) {
    const std::optional<ReliefRecord>& record = reader.manifest().relief;
    if (!record) {
        return {};
    }
    const Result<Bytes> atlas = reader.take(record->atlas);
    if (!atlas) {
        return tl::unexpected(atlas.error());
    }
    Result<Image16> relief = decode_png16(*atlas, most_texels);
    if (!relief) {
        return at(record->atlas, relief.error());
    }
    const Result<Bytes> charts_bytes = reader.take(record->charts);
    if (!charts_bytes) {
        return tl::unexpected(charts_bytes.error());
    }
    Result<std::vector<ReliefChart>> charts = decode_charts(*charts_bytes);
    if (!charts) {
        return at(record->charts, charts.error());
    }
    pack.relief = {record->texel_box, std::move(*charts), std::move(*relief)};
    return {};
}

Result<PackLevel> read_level(PackReader& reader, const LevelRecord& record, const Pack& pack) {
    const Result<Bytes> bytes = reader.take(record.mesh);
    if (!bytes) {
        return tl::unexpected(bytes.error());
    }
    Result<PackLevel> level = decode_level(*bytes, pack.relief, pack.box_size);
    if (!level) {
        return at(record.mesh, level.error());
    }
    if (level->technique != record.technique || level->vertices.size() != record.vertices ||
        level->indices.size() != record.triangles * 3) {
        return bad_input(
            fmt::format("{} holds other triangles than the manifest says; the pack is altered", record.mesh));
    }
    level->error = record.error;
    level->texture = record.texture;
    return level;
}

Result<void> read_levels(PackReader& reader, Pack& pack) {
    for (const LevelRecord& record : reader.manifest().levels) {
        Result<PackLevel> level = read_level(reader, record, pack);
        if (!level) {
            return tl::unexpected(level.error());
        }
        pack.levels.push_back(std::move(*level));
    }
    return {};
}

/// Each step needs that the ones before it passed.
Result<void> read_all(PackReader& reader, Pack& pack) {
    return check_texts(pack)
        .and_then([&] { return check_placement(pack); })
        .and_then([&] { return read_textures(reader, pack); })
        .and_then([&] { return read_relief(reader, pack); })
        .and_then([&] { return check_pictures(pack); })
        .and_then([&] { return read_levels(reader, pack); })
        .and_then([&] { return check_levels(pack); })
        .and_then([&] { return reader.finish(); });
}

} // namespace

Result<VerifiedPack> verify_pack(std::span<const std::byte> bytes) {
    Result<PackReader> reader = PackReader::open(bytes);
    if (!reader) {
        return tl::unexpected(reader.error());
    }
    Pack pack = reader->manifest().description;
    if (auto good = read_all(*reader, pack); !good) {
        return tl::unexpected(good.error());
    }
    return VerifiedPack(std::move(pack));
}

Result<VerifiedPack> load_pack(const std::filesystem::path& file) {
    const Result<Bytes> bytes = read_file(file, most_pack_bytes);
    if (!bytes) {
        return tl::unexpected(bytes.error());
    }
    Result<VerifiedPack> pack = verify_pack(*bytes);
    if (!pack) {
        return at(file.string(), pack.error());
    }
    return pack;
}

} // namespace frustumscreen
