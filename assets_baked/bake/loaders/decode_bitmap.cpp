#include "assets_baked/bake/loaders/decode_bitmap.h"

#include "assets_baked/bake/loaders/picture_bytes.h"
#include "firmware_host/base/file.h"

#include <stb/stb_image.h>

#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>

namespace frustumscreen::bake {

namespace {

/// The picture's properties from its header.
struct Header {
    std::int64_t width = 0;
    std::int64_t height = 0;
    std::int64_t bits = 0;   ///< a texel
    std::uint64_t begin = 0; ///< offset of the texels
    bool packed = false;     ///< run-length encoded
};

struct PixelsFree {
    void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

tl::unexpected<Error> damaged(const char* kind, const char* why) {
    return bad_input("picture.bitmap_damaged",
                     "the {} picture is damaged, or of a kind that cannot be read ({}); save it as PNG", kind,
                     why);
}

/// Reads the old header of 12 bytes and the later ones of 40 and more.
std::optional<Header> bmp_header(ByteView bytes) {
    constexpr std::size_t shortest = 26;
    if (bytes.size() < shortest) {
        return std::nullopt;
    }
    Header header;
    header.begin = load_little<std::uint32_t>(bytes, 10);
    const auto size = load_little<std::uint32_t>(bytes, 14);
    if (size == 12) {
        header.width = load_little<std::uint16_t>(bytes, 18);
        header.height = load_little<std::uint16_t>(bytes, 20);
        header.bits = load_little<std::uint16_t>(bytes, 24);
        return header;
    }
    if (size < 40 || bytes.size() < 54) {
        return std::nullopt;
    }
    header.width = load_little<std::int32_t>(bytes, 18);
    header.height =
        std::abs(std::int64_t{load_little<std::int32_t>(bytes, 22)}); // negative: the top row comes first
    header.bits = load_little<std::uint16_t>(bytes, 28);
    const auto packing = load_little<std::uint32_t>(bytes, 30);
    header.packed = packing != 0 && packing != 3; // 3: plain, with masks
    return header;
}

Header tga_header(ByteView bytes) {
    Header header;
    const auto id_bytes = load_little<std::uint8_t>(bytes, 0);
    const bool has_palette = load_little<std::uint8_t>(bytes, 1) == 1;
    const std::uint64_t entries = load_little<std::uint16_t>(bytes, 5);
    const std::uint64_t entry_bytes = (load_little<std::uint8_t>(bytes, 7) + 7U) / 8U;
    header.width = load_little<std::uint16_t>(bytes, 12);
    header.height = load_little<std::uint16_t>(bytes, 14);
    header.bits = load_little<std::uint8_t>(bytes, 16);
    header.begin = 18 + id_bytes + (has_palette ? entries * entry_bytes : 0);
    header.packed = load_little<std::uint8_t>(bytes, 2) >= 8;
    return header;
}

/// True if the runs of a packed TGA extend to its last texel.
bool runs_reach_the_end(ByteView bytes, const Header& header) {
    const auto texel_bytes = static_cast<std::uint64_t>((header.bits + 7) / 8);
    std::uint64_t left = static_cast<std::uint64_t>(header.width * header.height);
    std::uint64_t position = header.begin;
    while (left > 0) {
        if (position >= bytes.size()) {
            return false;
        }
        const auto run = std::to_integer<unsigned>(bytes[static_cast<std::size_t>(position)]);
        const std::uint64_t count = (run & 0x7fU) + 1;
        position += 1 + texel_bytes * ((run & 0x80U) != 0 ? 1 : count);
        left -= std::min(left, count);
    }
    return position <= bytes.size();
}

/// Decodes with the library into a picture whose size was checked before.
Result<image::Image8> unpack(const char* kind, ByteView bytes, const Header& header,
                             std::int64_t limit_texels) {
    TRY(image::Image8 picture, blank_image(header.width, header.height, limit_texels));
    if (bytes.size() > std::size_t{std::numeric_limits<int>::max()}) {
        return damaged(kind, "more than 2 GiB");
    }
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<stbi_uc, PixelsFree> pixels(stbi_load_from_memory(
        raw(bytes), static_cast<int>(bytes.size()), &width, &height, &channels, STBI_rgb_alpha));
    if (!pixels) {
        return damaged(kind, stbi_failure_reason());
    }
    if (width != picture.width || height != picture.height) {
        return damaged(kind, "its header has two sizes");
    }
    std::memcpy(raw(picture), pixels.get(), picture.texels.size() * 4);
    return picture;
}

} // namespace

bool is_bmp(ByteView bytes) {
    return as_text(bytes).starts_with("BM");
}

Result<image::Image8> decode_bmp(ByteView bytes, std::int64_t limit_texels) {
    const std::optional<Header> header = bmp_header(bytes);
    if (!header) {
        return damaged("BMP", "it has no header");
    }
    if (header->packed) {
        return damaged("BMP", "it is packed");
    }
    TRY_VOID(without_value(blank_image(header->width, header->height, limit_texels)));
    const std::int64_t row_bytes = (header->width * header->bits + 31) / 32 * 4;
    if (header->begin > bytes.size() ||
        static_cast<std::uint64_t>(row_bytes * header->height) > bytes.size() - header->begin) {
        return damaged("BMP", "it ends too early");
    }
    return unpack("BMP", bytes, *header, limit_texels);
}

bool is_tga(ByteView bytes) {
    constexpr std::size_t header_bytes = 18;
    if (bytes.size() < header_bytes) {
        return false;
    }
    const auto palette = load_little<std::uint8_t>(bytes, 1);
    const unsigned kind = load_little<std::uint8_t>(bytes, 2) & ~8U; // 8: run-length encoded
    const auto bits = load_little<std::uint8_t>(bytes, 16);
    return palette <= 1 && load_little<std::uint8_t>(bytes, 2) < 16 && kind >= 1 && kind <= 3 &&
           (kind == 1) == (palette == 1) &&
           (bits == 8 || bits == 15 || bits == 16 || bits == 24 || bits == 32);
}

Result<image::Image8> decode_tga(ByteView bytes, std::int64_t limit_texels) {
    const Header header = tga_header(bytes);
    TRY_VOID(without_value(blank_image(header.width, header.height, limit_texels)));
    const auto plain_bytes = static_cast<std::uint64_t>((header.bits + 7) / 8 * header.width * header.height);
    const bool whole = header.packed
                           ? runs_reach_the_end(bytes, header)
                           : header.begin <= bytes.size() && plain_bytes <= bytes.size() - header.begin;
    if (!whole) {
        return damaged("TGA", "it ends too early");
    }
    return unpack("TGA", bytes, header, limit_texels);
}

} // namespace frustumscreen::bake
