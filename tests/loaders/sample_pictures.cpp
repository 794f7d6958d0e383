#include "tests/loaders/sample_pictures.h"

#include "firmware_host/base/file.h"

#include <png.h>
#include <turbojpeg.h>
#include <webp/encode.h>

#include <vector>

namespace frustumscreen::testing {

namespace {

const unsigned char* raw(const image::Image8& image) {
    return reinterpret_cast<const unsigned char*>(image.texels.data());
}

void append(png_structp png, png_bytep bytes, std::size_t size) {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(bytes), size);
}

} // namespace

image::Image8 smooth_picture(int width, int height) {
    image::Image8 image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            image.at(x, y) = glm::u8vec4(60 + 120 * x / width, 200 - 100 * y / height, 90, 255);
        }
    }
    return image;
}

std::string png_of(const image::Image8& image) {
    const Bytes bytes = image::encode_png(image);
    return std::string(as_text(bytes));
}

std::string jpeg_of(const image::Image8& image) {
    const tjhandle handle = tjInitCompress();
    unsigned char* out = nullptr;
    unsigned long size = 0;
    tjCompress2(handle, raw(image), image.width, 0, image.height, TJPF_RGBA, &out, &size, TJSAMP_444, 95,
                TJFLAG_ACCURATEDCT);
    std::string bytes(reinterpret_cast<const char*>(out), size);
    tjFree(out);
    tjDestroy(handle);
    return bytes;
}

std::string webp_of(const image::Image8& image) {
    std::uint8_t* out = nullptr;
    const std::size_t size =
        WebPEncodeLosslessRGBA(raw(image), image.width, image.height, image.width * 4, &out);
    std::string bytes(reinterpret_cast<const char*>(out), size);
    WebPFree(out);
    return bytes;
}

namespace {

std::string number(std::uint32_t value, int bytes, bool big = false) {
    std::string text;
    for (int k = 0; k < bytes; ++k) {
        text += static_cast<char>((value >> (8 * (big ? bytes - 1 - k : k))) & 0xffU);
    }
    return text;
}

/// Order: blue, green, red.
std::string texel_bgr(const glm::u8vec4& texel) {
    return number(texel.b, 1) + number(texel.g, 1) + number(texel.r, 1);
}

} // namespace

std::string bmp_of(const image::Image8& image, bool top_row_first) {
    std::string texels;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            texels += texel_bgr(image.at(x, top_row_first ? y : image.height - 1 - y));
        }
        texels.resize((texels.size() + 3) / 4 * 4, '\0');
    }
    const auto width = static_cast<std::uint32_t>(image.width);
    const auto height = static_cast<std::uint32_t>(top_row_first ? -image.height : image.height);
    return "BM" + number(54 + static_cast<std::uint32_t>(texels.size()), 4) + number(0, 4) + number(54, 4) +
           number(40, 4) + number(width, 4) + number(height, 4) + number(1, 2) + number(24, 2) +
           std::string(24, '\0') + texels;
}

std::string tga_of(const image::Image8& image, bool packed) {
    std::string file = number(0, 2) + number(packed ? 10 : 2, 1) + std::string(9, '\0') +
                       number(static_cast<std::uint32_t>(image.width), 2) +
                       number(static_cast<std::uint32_t>(image.height), 2) + number(24, 1) + number(0x20, 1);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            if (packed && x + 1 < image.width && image.at(x, y) == image.at(x + 1, y)) {
                file += number(0x81, 1) + texel_bgr(image.at(x, y)); // two equal texels
                ++x;
            } else {
                file += (packed ? number(0, 1) : std::string()) + texel_bgr(image.at(x, y));
            }
        }
    }
    return file;
}

std::string tiff_of(const image::Image8& image, TiffAlpha alpha, bool big) {
    const std::uint32_t channels = alpha == TiffAlpha::None ? 3 : 4;
    std::string texels;
    for (const glm::u8vec4& texel : image.texels) {
        for (std::uint32_t k = 0; k < channels; ++k) {
            const bool multiply = alpha == TiffAlpha::Multiplied && k < 3;
            texels += number(multiply ? (texel[static_cast<int>(k)] * texel.a + 127U) / 255U
                                      : texel[static_cast<int>(k)],
                             1);
        }
    }
    const std::uint32_t depths = 8; // offset of the channels' bit depths
    const std::uint32_t begin = depths + 8;
    const auto size = static_cast<std::uint32_t>(texels.size());
    std::string fields;
    std::uint32_t count = 0;
    const auto field = [&](std::uint32_t tag, std::uint32_t value, std::uint32_t values = 1,
                           bool is_short = true) {
        const bool inside = is_short && values == 1;
        fields += number(tag, 2, big) + number(is_short ? 3 : 4, 2, big) + number(values, 4, big) +
                  (inside ? number(value, 2, big) + number(0, 2, big) : number(value, 4, big));
        ++count;
    };
    field(256, static_cast<std::uint32_t>(image.width));
    field(257, static_cast<std::uint32_t>(image.height));
    field(258, depths, channels);
    field(259, 1); // uncompressed
    field(262, 2); // RGB
    field(273, begin, 1, false);
    field(277, channels);
    field(278, static_cast<std::uint32_t>(image.height));
    field(279, size, 1, false);
    if (alpha != TiffAlpha::None) {
        field(338, alpha == TiffAlpha::Multiplied ? 1 : 2);
    }
    std::string file = std::string(big ? "MM" : "II") + number(42, 2, big) + number(begin + size, 4, big);
    for (int k = 0; k < 4; ++k) {
        file += number(8, 2, big);
    }
    return file + texels + number(count, 2, big) + fields + number(0, 4);
}

std::string grey_ramp_png(int depth, bool with_gamma) {
    const int width = depth == 16 ? 256 : 1 << depth;
    std::string file;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &file, append, nullptr);
    png_set_IHDR(png, info, static_cast<png_uint_32>(width), 1, depth, PNG_COLOR_TYPE_GRAY,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (with_gamma) {
        png_set_gAMA(png, info, 1.0);
    }
    png_write_info(png, info);
    std::vector<png_byte> row(static_cast<std::size_t>(width) * 2 + 1, png_byte{0});
    for (int x = 0; x < width; ++x) {
        const auto place = static_cast<std::size_t>(x);
        if (depth == 16) {
            row[place * 2] = row[place * 2 + 1] = static_cast<png_byte>(x);
        } else {
            const int shift = 8 - depth - (x * depth) % 8;
            row[place * static_cast<std::size_t>(depth) / 8] |= static_cast<png_byte>(x << shift);
        }
    }
    png_write_row(png, row.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return file;
}

} // namespace frustumscreen::testing
