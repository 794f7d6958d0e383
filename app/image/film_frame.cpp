#include "app/image/film_frame.h"

#include <fmt/format.h>
#include <webp/decode.h>
#include <webp/encode.h>

namespace frustumscreen::image {

namespace {

const std::uint8_t* raw(std::span<const std::byte> bytes) {
    return reinterpret_cast<const std::uint8_t*>(bytes.data());
}

struct Picture {
    Picture() { good = WebPPictureInit(&picture) != 0; }
    ~Picture() { WebPPictureFree(&picture); }
    Picture(const Picture&) = delete;
    Picture& operator=(const Picture&) = delete;
    WebPPicture picture{};
    bool good = false;
};

} // namespace

Result<PictureExtent> extent_of_still(std::span<const std::byte> beginning) {
    WebPBitstreamFeatures features;
    if (!begins_as_webp(beginning) ||
        WebPGetFeatures(raw(beginning), beginning.size(), &features) != VP8_STATUS_OK) {
        return bad_input("image.still_damaged", "it is not a WebP picture, or is damaged");
    }
    if (features.has_animation != 0) {
        return bad_input("image.still_moves", "it is an animated WebP; allowed is a still picture");
    }
    return PictureExtent{features.width, features.height};
}

Result<Image8> decode_still(std::span<const std::byte> bytes, const PictureExtent& expected) {
    TRY(const PictureExtent extent, extent_of_still(bytes));
    if (extent.width != expected.width || extent.height != expected.height) {
        return bad_input("image.still_size", "it has {} x {} pixels; expected are {} x {}", extent.width,
                         extent.height, expected.width, expected.height);
    }
    Image8 image(static_cast<int>(extent.width), static_cast<int>(extent.height));
    if (WebPDecodeRGBAInto(raw(bytes), bytes.size(), &image.texels[0].x, 4 * image.texels.size(),
                           4 * image.width) == nullptr) {
        return bad_input("image.still_truncated", "the WebP picture is damaged or truncated");
    }
    return image;
}

Bytes encode_film_frame(const Image8& image, float quality) {
    WebPConfig config;
    Picture holder;
    if (WebPConfigPreset(&config, WEBP_PRESET_PHOTO, quality) == 0 || !holder.good || image.texels.empty()) {
        return {};
    }
    config.alpha_quality = 100;
    WebPPicture& picture = holder.picture;
    picture.width = image.width;
    picture.height = image.height;
    WebPMemoryWriter writer;
    WebPMemoryWriterInit(&writer);
    picture.writer = WebPMemoryWrite;
    picture.custom_ptr = &writer;
    Bytes bytes;
    if (WebPPictureImportRGBA(&picture, &image.texels[0].x, 4 * image.width) != 0 &&
        WebPEncode(&config, &picture) != 0) {
        const auto* const begin = reinterpret_cast<const std::byte*>(writer.mem);
        bytes.assign(begin, begin + writer.size);
    }
    WebPMemoryWriterClear(&writer);
    return bytes;
}

} // namespace frustumscreen::image
