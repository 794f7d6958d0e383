/// Decodes the pictures of one model, with one limit of texels for all of them.
///
/// Errors   throws Refusal.
#pragma once

#include "assets_baked/bake/loaders/decode_image.h"
#include "assets_baked/bake/loaders/refusal.h"

#include <memory>
#include <string_view>

namespace frustumscreen {

class PictureStore {
public:
    [[nodiscard]] std::shared_ptr<const Image8> decode(ByteView bytes, std::string_view place) {
        Result<Image8> picture = decode_image(bytes, texels_left_);
        if (!picture) {
            refuse("{}: {}", place, picture.error().message);
        }
        texels_left_ -= static_cast<std::int64_t>(picture->texels.size());
        return std::make_shared<const Image8>(*std::move(picture));
    }

private:
    std::int64_t texels_left_ = most_texture_texels;
};

} // namespace frustumscreen
