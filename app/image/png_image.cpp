#include "app/image/image.h"

#include <png.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <string>

namespace frustumscreen::image {

namespace {

struct FreePng {
    void operator()(png_image* png) const {
        png_image_free(png);
        delete png;
    }
};
using PngImage = std::unique_ptr<png_image, FreePng>;

PngImage new_png() {
    PngImage png(new png_image{});
    png->version = PNG_IMAGE_VERSION;
    return png;
}

tl::unexpected<Error> damaged(const png_image& png) {
    return bad_input("image.png_damaged", "the PNG picture is damaged (" + std::string(png.message) + ")");
}

/// Reads the header and checks its size against the limit before allocating anything of that size.
Result<PngImage> begin_decode(std::span<const std::byte> bytes, std::int64_t limit_texels) {
    PngImage png = new_png();
    if (bytes.empty() || png_image_begin_read_from_memory(png.get(), bytes.data(), bytes.size()) == 0) {
        return bytes.empty() ? bad_input("image.png_empty", "the PNG picture is empty") : damaged(*png);
    }
    const std::int64_t texels = static_cast<std::int64_t>(png->width) * png->height;
    if (texels > limit_texels) {
        return bad_input("image.png_too_large", "the PNG picture has " + std::to_string(png->width) + " x " +
                                                    std::to_string(png->height) + " texels, allowed are " +
                                                    std::to_string(limit_texels) + " in all");
    }
    return png;
}

template <typename Texel> Result<Image<Texel>> finish_decode(PngImage png, png_uint_32 format) {
    Image<Texel> image(static_cast<int>(png->width), static_cast<int>(png->height));
    png->format = format;
    if (png_image_finish_read(png.get(), nullptr, image.texels.data(), 0, nullptr) == 0) {
        return damaged(*png);
    }
    return image;
}

/// Empty if libpng refuses the size (no texels, or more than a million in a row).
Bytes encode(int width, int height, png_uint_32 format, const void* texels) {
    if (width <= 0 || height <= 0) {
        return {};
    }
    PngImage png = new_png();
    png->width = static_cast<png_uint_32>(width);
    png->height = static_cast<png_uint_32>(height);
    png->format = format;
    png->flags = PNG_IMAGE_FLAG_FAST;
    // One pass into a buffer that suffices for every picture of this size.
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(*png);
    Bytes bytes(size);
    if (png_image_write_to_memory(png.get(), bytes.data(), &size, 0, texels, 0, nullptr) == 0) {
        return {};
    }
    bytes.resize(size);
    bytes.shrink_to_fit();
    return bytes;
}

} // namespace

Result<PictureExtent> extent_of_png(std::span<const std::byte> beginning) {
    constexpr std::int64_t no_limit = std::numeric_limits<std::int64_t>::max();
    return begin_decode(beginning, no_limit).map([](const PngImage& png) {
        return PictureExtent{png->width, png->height};
    });
}

Result<Image8> decode_png8(std::span<const std::byte> bytes, std::int64_t limit_texels) {
    TRY(PngImage png, begin_decode(bytes, limit_texels));
    // Pictures of 16 bits without a gamma chunk are sRGB here; libpng would treat them as linear light.
    png->flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
    return finish_decode<glm::u8vec4>(std::move(png), PNG_FORMAT_RGBA);
}

Result<Image16> decode_png16(std::span<const std::byte> bytes, std::int64_t limit_texels) {
    TRY(PngImage png, begin_decode(bytes, limit_texels));
    if (png->format != PNG_FORMAT_LINEAR_Y) {
        return bad_input("image.png_not_grey16", "the PNG picture is not 16-bit grey");
    }
    return finish_decode<std::uint16_t>(std::move(png), PNG_FORMAT_LINEAR_Y);
}

Bytes encode_png(const Image8& image) {
    const bool opaque = std::all_of(image.texels.begin(), image.texels.end(),
                                    [](const glm::u8vec4& texel) { return texel.a == 255; });
    if (!opaque) {
        return encode(image.width, image.height, PNG_FORMAT_RGBA, image.texels.data());
    }
    std::vector<glm::u8vec3> rgb(image.texels.begin(), image.texels.end());
    return encode(image.width, image.height, PNG_FORMAT_RGB, rgb.data());
}

Bytes encode_png(const Image16& image) {
    return encode(image.width, image.height, PNG_FORMAT_LINEAR_Y, image.texels.data());
}

} // namespace frustumscreen::image
