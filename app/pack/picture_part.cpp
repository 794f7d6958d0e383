#include "app/pack/picture_part.h"

#include "app/pack/check_pack.h"
#include "app/pack/limits.h"

namespace frustumscreen::pack_format {

Result<Image8> read_picture(PackReader& reader, const std::string& name, std::int64_t most_texels) {
    const Result<Bytes> bytes = reader.take(name);
    if (!bytes) {
        return tl::unexpected(bytes.error());
    }
    Result<Image8> picture =
        begins_as_webp(*bytes) ? decode_webp8(*bytes, most_texels) : decode_png8(*bytes, most_texels);
    if (!picture) {
        return at(name, picture.error());
    }
    return picture;
}

Result<Image8> read_table_picture(PackReader& reader) {
    constexpr std::int64_t most_texels = std::int64_t{most_table_picture_side} * most_table_picture_side;
    const std::string& name = reader.manifest().table_picture;
    if (name.empty()) {
        return Image8{};
    }
    Result<Image8> picture = read_picture(reader, name, most_texels);
    if (!picture) {
        return picture;
    }
    if (const Result<void> good = check_table_picture(*picture); !good) {
        return at(name, good.error());
    }
    return picture;
}

} // namespace frustumscreen::pack_format
