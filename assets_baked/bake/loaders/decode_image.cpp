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

namespace frustumscreen::bake {

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
        const std::size_t left = png.size() - position - frame;
        const std::size_t length = load<std::uint32_t>(png, position, std::endian::big);
        const ByteView chunk = png.subspan(position, frame + std::min(length, left));
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

Result<image::Image8> decode_png(ByteView bytes, std::int64_t limit_texels) {
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
    TRY(image::Image8 picture, blank_image(reader.image.width, reader.image.height, limit_texels));
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

class JpegReader {
public:
    explicit JpegReader(ByteView bytes) : bytes_(bytes), handle_(tjInitDecompress()) {}

    /// The size in the file.
    Result<glm::ivec2> read_size() {
        glm::ivec2 size(0);
        int subsampling = 0;
        int colours = 0;
        if (tjDecompressHeader3(handle_.get(), raw(bytes_), length(), &size.x, &size.y, &subsampling,
                                &colours) != 0) {
            return damaged();
        }
        if (colours == TJCS_CMYK || colours == TJCS_YCCK) {
            return bad_input("picture.jpeg_cmyk", "the JPEG picture is CMYK; save it as RGB");
        }
        return size;
    }

    /// The picture with each side divided by `divisor`, which is 1, 2, 4 or 8, and rounded up.
    Result<image::Image8> read(const glm::ivec2& size, int divisor, std::int64_t limit_texels) {
        const tjscalingfactor factor{1, divisor};
        TRY(image::Image8 picture,
            blank_image(TJSCALED(size.x, factor), TJSCALED(size.y, factor), limit_texels));
        if (tjDecompress2(handle_.get(), raw(bytes_), length(), raw(picture), picture.width, 0,
                          picture.height, TJPF_RGBA, TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS) != 0 &&
            !is_harmless(tjGetErrorStr2(handle_.get()))) {
            return damaged();
        }
        return picture;
    }

private:
    [[nodiscard]] unsigned long length() const { return static_cast<unsigned long>(bytes_.size()); }
    [[nodiscard]] tl::unexpected<Error> damaged() const {
        return bad_input("picture.jpeg_damaged", "the JPEG picture is damaged: {}",
                         tjGetErrorStr2(handle_.get()));
    }

    ByteView bytes_;
    std::unique_ptr<void, JpegCloser> handle_;
};

Result<image::Image8> decode_jpeg(ByteView bytes, std::int64_t limit_texels) {
    JpegReader reader(bytes);
    TRY(const glm::ivec2 size, reader.read_size());
    return reader.read(size, 1, limit_texels);
}

/// The decoder itself halves up to three times, so a large picture never lies in memory whole.
Result<ShrunkImage> decode_jpeg_shrunk(ByteView bytes, std::int64_t kept_texels, std::int64_t limit_texels) {
    constexpr std::int64_t max_coded_texels = std::int64_t{1} << 30; // bounds the time
    JpegReader reader(bytes);
    TRY(const glm::ivec2 size, reader.read_size());
    const std::int64_t texels = std::int64_t{size.x} * size.y;
    if (texels > max_coded_texels) {
        return too_large(size.x, size.y, max_coded_texels);
    }
    int divisor = 1;
    while (divisor < 8 && texels > kept_texels * divisor * divisor) {
        divisor *= 2;
    }
    TRY(image::Image8 image, reader.read(size, divisor, limit_texels));
    return ShrunkImage{std::move(image), size};
}

bool is_jpeg(ByteView bytes) {
    return begins_with(bytes, "\xff\xd8");
}

Result<image::Image8> decode_webp(ByteView bytes, std::int64_t limit_texels) {
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(raw(bytes), bytes.size(), &features) != VP8_STATUS_OK) {
        return bad_input("picture.webp_damaged", "the WebP picture is damaged");
    }
    if (features.has_animation != 0) {
        return bad_input("picture.webp_animated", "the WebP picture is animated; save it as a still picture");
    }
    TRY(image::Image8 picture, blank_image(features.width, features.height, limit_texels));
    if (WebPDecodeRGBAInto(raw(bytes), bytes.size(), raw(picture), picture.texels.size() * 4,
                           features.width * 4) == nullptr) {
        return bad_input("picture.webp_truncated", "the WebP picture is damaged or truncated");
    }
    return picture;
}

} // namespace

Result<image::Image8> decode_image(ByteView bytes, std::int64_t limit_texels) {
    if (begins_with(bytes, "\x89PNG\r\n")) {
        return decode_png(bytes, limit_texels);
    }
    if (is_jpeg(bytes)) {
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

Result<ShrunkImage> decode_shrunk(ByteView bytes, std::int64_t kept_texels, std::int64_t limit_texels) {
    ShrunkImage shrunk;
    if (is_jpeg(bytes)) {
        TRY(shrunk, decode_jpeg_shrunk(bytes, kept_texels, limit_texels));
    } else {
        TRY(shrunk.image, decode_image(bytes, limit_texels));
        shrunk.file_size = {shrunk.image.width, shrunk.image.height};
    }
    while (texels_of(shrunk.image) > std::max<std::int64_t>(kept_texels, 1)) {
        shrunk.image = image::half_size(shrunk.image);
    }
    return shrunk;
}

} // namespace frustumscreen::bake
