#include "assets_baked/bake/loaders/decode_image.h"

#include "assets_baked/bake/loaders/decode_bitmap.h"
#include "assets_baked/bake/loaders/decode_png.h"
#include "assets_baked/bake/loaders/decode_tiff.h"
#include "assets_baked/bake/loaders/picture_bytes.h"
#include "firmware_host/base/file.h"

#include <turbojpeg.h>
#include <webp/decode.h>

#include <algorithm>
#include <memory>
#include <string_view>

namespace frustumscreen::bake {

namespace {

bool begins_with(ByteView bytes, std::string_view magic) {
    return as_text(bytes).starts_with(magic);
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
            return damaged(tjGetErrorStr2(handle_.get()));
        }
        if (size.x < 1 || size.y < 1) { // no error of libjpeg's for a file that ends in its header
            return damaged("it ends before its size");
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
            return damaged(tjGetErrorStr2(handle_.get()));
        }
        return picture;
    }

private:
    [[nodiscard]] unsigned long length() const { return static_cast<unsigned long>(bytes_.size()); }
    [[nodiscard]] static tl::unexpected<Error> damaged(std::string_view why) {
        return bad_input("picture.jpeg_damaged", "the JPEG picture is damaged: {}", why);
    }

    ByteView bytes_;
    std::unique_ptr<void, JpegCloser> handle_;
};

/// The decoder itself halves up to three times, so a large picture never lies in memory whole.
Result<ShrunkImage> decode_jpeg(ByteView bytes, const Halvings& halvings, std::int64_t limit_texels) {
    constexpr int most = 3;
    JpegReader reader(bytes);
    TRY(const glm::ivec2 size, reader.read_size());
    if (std::int64_t{size.x} * size.y > max_coded_texels) {
        return too_large(size.x, size.y, max_coded_texels);
    }
    const int times = halvings(size);
    const int inside = std::min(times, most);
    TRY(image::Image8 image, reader.read(size, 1 << inside, limit_texels));
    return ShrunkImage{halved(std::move(image), times - inside), size};
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

/// Pictures of the kinds that are not shrunk while they are decoded.
Result<image::Image8> decode_whole(ByteView bytes, std::int64_t limit_texels) {
    if (begins_with(bytes, "RIFF") && bytes.size() >= 12 && as_text(bytes.subspan(8, 4)) == "WEBP") {
        return decode_webp(bytes, limit_texels);
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

} // namespace

Result<ShrunkImage> decode_shrunk(ByteView bytes, const Halvings& halvings, std::int64_t limit_texels) {
    if (is_png(bytes)) {
        return decode_png(bytes, halvings, limit_texels);
    }
    if (is_jpeg(bytes)) {
        return decode_jpeg(bytes, halvings, limit_texels);
    }
    if (is_tiff(bytes)) {
        return decode_tiff(bytes, halvings, limit_texels);
    }
    TRY(image::Image8 whole, decode_whole(bytes, limit_texels));
    const glm::ivec2 size(whole.width, whole.height);
    return ShrunkImage{halved(std::move(whole), halvings(size)), size};
}

Result<image::Image8> decode_image(ByteView bytes, std::int64_t limit_texels) {
    TRY(ShrunkImage whole, decode_shrunk(
                               bytes, [](const glm::ivec2&) { return 0; }, limit_texels));
    return std::move(whole.image);
}

} // namespace frustumscreen::bake
