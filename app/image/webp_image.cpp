#include "app/image/image.h"

#include <webp/decode.h>
#include <webp/encode.h>

#include <memory>
#include <string>

namespace frustumscreen::image {

namespace {

const std::uint8_t* raw(std::span<const std::byte> bytes) {
    return reinterpret_cast<const std::uint8_t*>(bytes.data());
}

struct FreePicture {
    void operator()(WebPPicture* picture) const {
        WebPPictureFree(picture);
        delete picture;
    }
};

/// `import` reads the texels in the image's memory layout.
Bytes encode(const Image8& image, const WebPConfig& config,
             int (*import)(WebPPicture*, const std::uint8_t*, int)) {
    const std::unique_ptr<WebPPicture, FreePicture> picture(new WebPPicture{});
    if (WebPPictureInit(picture.get()) == 0 || image.texels.empty()) {
        return {};
    }
    picture->use_argb = config.lossless;
    picture->width = image.width;
    picture->height = image.height;
    WebPMemoryWriter writer;
    WebPMemoryWriterInit(&writer);
    picture->writer = WebPMemoryWrite;
    picture->custom_ptr = &writer;
    Bytes bytes;
    if (import(picture.get(), &image.texels[0].x, 4 * image.width) != 0 &&
        WebPEncode(&config, picture.get()) != 0) {
        const auto* begin = reinterpret_cast<const std::byte*>(writer.mem);
        bytes.assign(begin, begin + writer.size);
    }
    WebPMemoryWriterClear(&writer);
    return bytes;
}

} // namespace

Bytes encode_webp(const Image8& image) {
    WebPConfig config;
    if (WebPConfigInit(&config) == 0) {
        return {};
    }
    config.lossless = 1;
    config.exact = 1;    // keep colours where alpha is 0: filters mix them in
    config.method = 4;   // half of the bytes of a quick PNG, 0.4 s a million texels;
    config.quality = 50; // more effort saves 2 %
    return encode(image, config, WebPPictureImportRGBA);
}

Bytes encode_lossy_webp(const Image8& image, float quality) {
    WebPConfig config;
    return WebPConfigPreset(&config, WEBP_PRESET_PHOTO, quality) != 0
               ? encode(image, config, WebPPictureImportRGBX)
               : Bytes();
}

Result<PictureExtent> extent_of_webp(std::span<const std::byte> beginning) {
    constexpr int lossless_format = 2;
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(raw(beginning), beginning.size(), &features) != VP8_STATUS_OK) {
        return bad_input("image.webp_damaged", "the WebP picture is damaged");
    }
    if (features.has_animation != 0 || features.format != lossless_format) {
        return bad_input("image.webp_not_lossless", "the WebP picture is not a lossless still picture");
    }
    return PictureExtent{features.width, features.height};
}

Result<Image8> decode_webp8(std::span<const std::byte> bytes, std::int64_t limit_texels) {
    TRY(const PictureExtent extent, extent_of_webp(bytes));
    if (extent.width * extent.height > limit_texels) {
        return bad_input("image.webp_too_large", "the WebP picture has " + std::to_string(extent.width) +
                                                     " x " + std::to_string(extent.height) +
                                                     " texels, allowed are " + std::to_string(limit_texels) +
                                                     " in all");
    }
    Image8 image(static_cast<int>(extent.width), static_cast<int>(extent.height));
    if (WebPDecodeRGBAInto(raw(bytes), bytes.size(), &image.texels[0].x, 4 * image.texels.size(),
                           4 * image.width) == nullptr) {
        return bad_input("image.webp_truncated", "the WebP picture is damaged or truncated");
    }
    return image;
}

bool begins_as_webp(std::span<const std::byte> bytes) {
    return bytes.size() >= 12 && as_text(bytes.first(4)) == "RIFF" && as_text(bytes.subspan(8, 4)) == "WEBP";
}

} // namespace frustumscreen::image
