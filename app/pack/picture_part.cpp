#include "app/pack/picture_part.h"

#include "app/pack/check_pack.h"
#include "app/pack/container/limits.h"

namespace frustumscreen::pack {

Result<image::Image8> read_picture(PackReader& reader, const std::string& name, std::int64_t max_texels) {
    TRY(const Bytes bytes, reader.take(name));
    return at(name, image::begins_as_webp(bytes) ? image::decode_webp8(bytes, max_texels)
                                                 : image::decode_png8(bytes, max_texels));
}

Result<image::Image8> read_table_picture(PackReader& reader) {
    constexpr std::int64_t max_texels = std::int64_t{max_table_picture_side} * max_table_picture_side;
    const std::string& name = reader.manifest().table_picture;
    if (name.empty()) {
        return image::Image8{};
    }
    TRY(image::Image8 picture, read_picture(reader, name, max_texels));
    TRY_VOID(at(name, check_table_picture(picture)));
    return picture;
}

} // namespace frustumscreen::pack
