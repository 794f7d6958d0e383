#include "assets_baked/bake/loaders/picture_store.h"

#include "firmware_host/base/printable.h"

namespace frustumscreen {

std::shared_ptr<const Image8> PictureStore::decode(ByteView bytes, std::string_view place) {
    Result<Image8> picture = decode_image(bytes, texels_left_);
    if (!picture) {
        refuse({ErrorKind::BadInput, picture.error().id,
                fmt::format("{} ({})", picture.error().message, place)});
    }
    texels_left_ -= static_cast<std::int64_t>(picture->texels.size());
    return std::make_shared<const Image8>(*std::move(picture));
}

std::shared_ptr<const Image8> PictureStore::named(std::string_view name, std::string_view place) {
    if (sidecars_.exists(name)) {
        return decode(*sidecars_.read(name, place), place);
    }
    if (has_curators()) {
        return curators();
    }
    const std::optional<std::string> like = sidecars_.like(name);
    refuse("mesh.picture_missing",
           "its picture \"{}\" is not beside it; put it there, or name another picture with --texture FILE{} "
           "({})",
           printable(last_part(name)), like ? ", such as " + printable(*like) : std::string(), place);
}

std::shared_ptr<const Image8> PictureStore::curators() {
    if (!curators_) {
        const Result<Bytes> bytes = read_file(texture_);
        if (!bytes) {
            refuse({ErrorKind::BadInput, bytes.error().id,
                    "the picture for its colours, " + bytes.error().message});
        }
        curators_ = decode(*bytes, "the picture for its colours, " + texture_.string());
    }
    return curators_;
}

} // namespace frustumscreen
