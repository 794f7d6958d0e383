#include "tests/loaders/sample_pictures.h"

#include "firmware_host/base/file.h"

#include <png.h>
#include <turbojpeg.h>
#include <webp/encode.h>

#include <vector>

namespace frustumscreen::testing {

namespace {

const unsigned char* raw(const Image8& image) {
    return reinterpret_cast<const unsigned char*>(image.texels.data());
}

void append(png_structp png, png_bytep bytes, std::size_t size) {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(bytes), size);
}

} // namespace

Image8 smooth_picture(int width, int height) {
    Image8 image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            image.at(x, y) = glm::u8vec4(60 + 120 * x / width, 200 - 100 * y / height, 90, 255);
        }
    }
    return image;
}

std::string png_of(const Image8& image) {
    const Bytes bytes = encode_png(image);
    return std::string(as_text(bytes));
}

std::string jpeg_of(const Image8& image) {
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

std::string webp_of(const Image8& image) {
    std::uint8_t* out = nullptr;
    const std::size_t size =
        WebPEncodeLosslessRGBA(raw(image), image.width, image.height, image.width * 4, &out);
    std::string bytes(reinterpret_cast<const char*>(out), size);
    WebPFree(out);
    return bytes;
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
