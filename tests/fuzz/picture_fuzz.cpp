// Pictures in packs and models: refused in one line, or of the announced size; encoding them as PNG and WebP
// and decoding gives equal pictures.
#include "assets_baked/bake/loaders/decode_image.h"
#include "tests/fuzz/fuzz.h"

using namespace frustumscreen;

namespace {

constexpr std::int64_t max_texels = 1 << 18; ///< keeps the fuzzer's memory small

template <typename Texel> void check(const Result<image::Image<Texel>>& image) {
    if (!image) {
        fuzz::require_one_line(image.error().message);
        return;
    }
    fuzz::require(image->width > 0 && image->height > 0, "a picture has a size");
    fuzz::require(static_cast<std::int64_t>(image->texels.size()) ==
                          static_cast<std::int64_t>(image->width) * image->height &&
                      static_cast<std::int64_t>(image->texels.size()) <= max_texels,
                  "a picture has its texels, no more than allowed");
    const Bytes png = image::encode_png(*image);
    Result<image::Image<Texel>> again;
    if constexpr (std::is_same_v<Texel, std::uint16_t>) {
        again = image::decode_png16(png);
    } else {
        again = image::decode_png8(png);
    }
    fuzz::require(again && again->width == image->width && again->height == image->height &&
                      again->texels == image->texels,
                  "a picture written again is the same", again ? std::string() : again.error().message);
    if constexpr (std::is_same_v<Texel, glm::u8vec4>) {
        const Bytes webp = image::encode_webp(*image);
        const Result<image::Image8> same = image::decode_webp8(webp);
        fuzz::require(webp.empty() || (same && same->width == image->width && same->texels == image->texels),
                      "a picture written as WebP is the same");
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span<const std::byte> bytes = fuzz::bytes_of(data, size);
    check(image::decode_png8(bytes, max_texels));
    check(image::decode_png16(bytes, max_texels));
    check(image::decode_webp8(bytes, max_texels));
    check(bake::decode_image(bytes, max_texels));
    const Result<bake::ShrunkImage> shrunk = bake::decode_shrunk(
        bytes, [](const glm::ivec2& size) { return bake::halvings_within(size, max_texels / 16); },
        max_texels);
    check(shrunk ? Result<image::Image8>(shrunk->image) : tl::unexpected<Error>(shrunk.error()));
    fuzz::require(!shrunk || shrunk->image.texels.size() <= max_texels / 16, "a shrunk picture is small");
    return 0;
}
