#include "assets_baked/bake/loaders/decode_image.h"

#include "assets_baked/bake/loaders/decode_bitmap.h"
#include "assets_baked/bake/loaders/decode_tiff.h"
#include "assets_baked/bake/loaders/picture_bytes.h"
#include "firmware_host/base/file.h"

#include <png.h>
#include <turbojpeg.h>
#include <webp/decode.h>

#include <array>
#include <memory>
#include <optional>
#include <string_view>

namespace frustumscreen {

namespace {

bool begins_with(ByteView bytes, std::string_view magic) {
    return as_text(bytes).starts_with(magic);
}

/// Keeps only the chunks that make texels: colour profiles must be ignored, and text need not be unpacked.
Bytes essential_png_chunks(ByteView png) {
    constexpr std::array kept = {std::string_view("IHDR"), std::string_view("PLTE"), std::string_view("tRNS"),
                                 std::string_view("IDAT"), std::string_view("IEND")};
    constexpr std::size_t signature = 8;
    constexpr std::size_t frame = 12; // length, type, checksum
    Bytes essential(png.begin(), png.begin() + signature);
    std::size_t position = signature;
    while (png.size() - position >= frame) {
        const std::size_t room = png.size() - position - frame;
        const std::size_t length = load<std::uint32_t>(png, position, std::endian::big);
        const ByteView chunk = png.subspan(position, frame + std::min(length, room));
        if (std::find(kept.begin(), kept.end(), as_text(chunk.subspan(4, 4))) != kept.end()) {
            essential.insert(essential.end(), chunk.begin(), chunk.end());
        }
        position += chunk.size();
    }
    return essential;
}

struct PngReader {
    PngReader() { image.version = PNG_IMAGE_VERSION; }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
    ~PngReader() { png_image_free(&image); }
    png_image image{};
};

Result<Image8> decode_png(ByteView bytes, std::int64_t limit_texels) {
    if (bytes.size() < 8) {
        return bad_input("picture.png_truncated", "the PNG picture is truncated");
    }
    const Bytes essential = essential_png_chunks(bytes);
    PngReader reader;
    if (png_image_begin_read_from_memory(&reader.image, essential.data(), essential.size()) == 0) {
        return bad_input("picture.png_damaged", "the PNG picture is damaged: {}", reader.image.message);
    }
    reader.image.format = PNG_FORMAT_RGBA;
    reader.image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
    TRY(Image8 picture, blank_image(reader.image.width, reader.image.height, limit_texels));
    png_image_finish_read(&reader.image, nullptr, raw(picture), 0, nullptr);
    if (PNG_IMAGE_FAILED(reader.image) || reader.image.warning_or_error != 0) {
        return bad_input("picture.png_rows_damaged", "the PNG picture is damaged: {}", reader.image.message);
    }
    return picture;
}

struct JpegCloser {
    void operator()(void* handle) const { tjDestroy(handle); }
};

/// Some cameras leave padding before the end marker; every other warning of libjpeg indicates damage.
bool is_harmless(std::string_view warning) {
    return warning.find("extraneous bytes before marker 0xd9") != std::string_view::npos;
}

Result<Image8> decode_jpeg(ByteView bytes, std::int64_t limit_texels) {
    const std::unique_ptr<void, JpegCloser> handle(tjInitDecompress());
    const auto damaged = [&] {
        return bad_input("picture.jpeg_damaged", "the JPEG picture is damaged: {}",
                         tjGetErrorStr2(handle.get()));
    };
    int width = 0;
    int height = 0;
    int subsampling = 0;
    int colours = 0;
    const auto size = static_cast<unsigned long>(bytes.size());
    if (tjDecompressHeader3(handle.get(), raw(bytes), size, &width, &height, &subsampling, &colours) != 0) {
        return damaged();
    }
    if (colours == TJCS_CMYK || colours == TJCS_YCCK) {
        return bad_input("picture.jpeg_cmyk", "the JPEG picture is CMYK; save it as RGB");
    }
    TRY(Image8 picture, blank_image(width, height, limit_texels));
    if (tjDecompress2(handle.get(), raw(bytes), size, raw(picture), width, 0, height, TJPF_RGBA,
                      TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS) != 0 &&
        !is_harmless(tjGetErrorStr2(handle.get()))) {
        return damaged();
    }
    return picture;
}

Result<Image8> decode_webp(ByteView bytes, std::int64_t limit_texels) {
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(raw(bytes), bytes.size(), &features) != VP8_STATUS_OK) {
        return bad_input("picture.webp_damaged", "the WebP picture is damaged");
    }
    if (features.has_animation != 0) {
        return bad_input("picture.webp_animated", "the WebP picture is animated; save it as a still picture");
    }
    TRY(Image8 picture, blank_image(features.width, features.height, limit_texels));
    if (WebPDecodeRGBAInto(raw(bytes), bytes.size(), raw(picture), picture.texels.size() * 4,
                           features.width * 4) == nullptr) {
        return bad_input("picture.webp_truncated", "the WebP picture is damaged or truncated");
    }
    return picture;
}

} // namespace

Result<Image8> decode_image(ByteView bytes, std::int64_t limit_texels) {
    if (begins_with(bytes, "\x89PNG\r\n")) {
        return decode_png(bytes, limit_texels);
    }
    if (begins_with(bytes, "\xff\xd8")) {
        return decode_jpeg(bytes, limit_texels);
    }
    if (begins_with(bytes, "RIFF") && bytes.size() >= 12 && as_text(bytes.subspan(8, 4)) == "WEBP") {
        return decode_webp(bytes, limit_texels);
    }
    if (is_tiff(bytes)) {
        return decode_tiff(bytes, limit_texels);
    }
    if (is_bmp(bytes)) {
        return decode_bmp(bytes, limit_texels);
    }
    if (is_tga(bytes)) { // last, because it has no reliable mark
        return decode_tga(bytes, limit_texels);
    }
    return bad_input("picture.unknown_format",
                     "the picture is neither PNG, JPEG, WebP, TIFF, BMP nor TGA; save it as PNG");
}

} // namespace frustumscreen
