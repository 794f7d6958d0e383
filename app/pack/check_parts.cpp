#include "app/pack/check_parts.h"

#include "app/image/image.h"
#include "app/pack/binary_parts.h"
#include "app/pack/check_pack.h"
#include "app/pack/container/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace frustumscreen::pack {

namespace {

/// Enough of a picture to hold all that precedes its texels.
constexpr std::size_t beginning_bytes = 64U << 10U;
constexpr std::size_t max_charts_bytes = 12 + 20 * max_charts;

class PartChecks {
public:
    PartChecks(PackReader& reader, const std::function<void(std::uint64_t bytes)>& progress)
        : reader_(reader), progress_(progress) {}

    Result<void> all();

private:
    Result<void> hash(const std::string& name);
    Result<void> level(const LevelRecord& record);
    Result<void> charts(const std::string& name);
    Result<void> picture(const std::string& name, std::int64_t max_side, std::int64_t max_area);
    Result<Bytes> beginning_of(const std::string& name, std::size_t max_bytes);
    PackReader& reader_;
    const std::function<void(std::uint64_t bytes)>& progress_;
    std::int64_t texels_left_ = max_texels_together;
};

Result<void> PartChecks::hash(const std::string& name) {
    return reader_.check(name, [this](std::span<const std::byte> bytes) { progress_(bytes.size()); });
}

Result<Bytes> PartChecks::beginning_of(const std::string& name, std::size_t max_bytes) {
    Bytes beginning;
    const Result<void> read = reader_.check(name, [&](std::span<const std::byte> bytes) {
        const auto more = bytes.first(std::min(bytes.size(), max_bytes - beginning.size()));
        beginning.insert(beginning.end(), more.begin(), more.end());
        progress_(bytes.size());
    });
    TRY_VOID(read);
    return beginning;
}

Result<void> PartChecks::level(const LevelRecord& record) {
    const ZipEntry* entry = reader_.zip().find(record.mesh);
    LevelScan scan(entry != nullptr ? entry->bytes : 0);
    const Result<void> read = reader_.check(record.mesh, [&](std::span<const std::byte> bytes) {
        scan.add(bytes);
        progress_(bytes.size());
    });
    TRY_VOID(read);
    return at(record.mesh, scan.finish(record.technique, record.triangles, record.vertices));
}

Result<void> PartChecks::charts(const std::string& name) {
    TRY(const Bytes bytes, beginning_of(name, max_charts_bytes + 1));
    return without_value(at(name, decode_charts(bytes)));
}

Result<void> PartChecks::picture(const std::string& name, std::int64_t max_side, std::int64_t max_area) {
    TRY(const Bytes bytes, beginning_of(name, beginning_bytes));
    TRY(const image::PictureExtent extent,
        at(name, image::begins_as_webp(bytes) ? image::extent_of_webp(bytes) : image::extent_of_png(bytes)));
    const std::int64_t area = extent.width * extent.height; // the decoders bound both to 31 bits
    if (area == 0 || std::max(extent.width, extent.height) > max_side || area > max_area) {
        return bad_input("pack.picture_size",
                         "{}: the picture has {} x {} texels; allowed are {} a side and {} in all", name,
                         extent.width, extent.height, max_side, max_area);
    }
    texels_left_ -= area;
    return {};
}

Result<void> PartChecks::all() {
    const Manifest& manifest = reader_.manifest();
    Result<void> good = check_description(manifest.description).and_then([&] {
        return check_level_count(manifest.description, manifest.levels.size());
    });
    for (std::size_t k = 0; good && k < manifest.textures.size(); ++k) {
        good = picture(manifest.textures[k], max_side_texels, std::min(max_texels, texels_left_));
    }
    if (good && manifest.relief) {
        good = picture(manifest.relief->atlas, max_side_texels, max_texels).and_then([&] {
            return charts(manifest.relief->charts);
        });
    }
    for (std::size_t k = 0; good && k < manifest.levels.size(); ++k) {
        good = level(manifest.levels[k]);
    }
    if (good && !manifest.table_picture.empty()) {
        constexpr std::int64_t side = max_table_picture_side;
        good = picture(manifest.table_picture, side, side * side);
    }
    for (const PackSection& section : manifest.description.sections) {
        for (std::size_t k = 0; good && k < section.parts.size(); ++k) {
            good = hash(section.parts[k]);
        }
    }
    return good.and_then([&] { return reader_.finish(); });
}

} // namespace

Result<void> check_parts(PackReader& reader, const std::function<void(std::uint64_t bytes)>& progress) {
    return PartChecks(reader, progress).all();
}

} // namespace frustumscreen::pack
