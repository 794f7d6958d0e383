/// Pictures in memory, and PNG and lossless WebP in and out.
///
/// Shape    row-major, row 0 at the top.
/// Colour   8-bit sRGB at the edges; `linear_from_srgb` and back for light.
/// Threads  values and pure functions; any.
#pragma once

#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen::image {

template <typename Texel> struct Image {
    int width = 0;
    int height = 0;
    std::vector<Texel> texels;

    Image() = default;
    Image(int w, int h, Texel fill = Texel{})
        : width(w), height(h), texels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), fill) {}
    [[nodiscard]] Texel& at(int x, int y) {
        return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
    [[nodiscard]] const Texel& at(int x, int y) const { return const_cast<Image*>(this)->at(x, y); }
};

using Image8 = Image<glm::u8vec4>;    ///< sRGB + alpha
using Image16 = Image<std::uint16_t>; ///< relief; for its codes see ReliefAtlas
using ImageFloat = Image<glm::vec3>;

/// sRGB transfer function, IEC 61966-2-1.
[[nodiscard]] double linear_from_srgb(double srgb01);
[[nodiscard]] double srgb_from_linear(double linear01);
/// linear_from_srgb for each 8-bit code.
[[nodiscard]] const std::array<float, 256>& linear_from_srgb8();
/// Nearest 8-bit code; clamps.
[[nodiscard]] std::uint8_t srgb8_from_linear(double linear01);

/// The next coarser mip level: half as wide and high (rounded down, at least 1), colour averaged by area in
/// linear light. Equal on every machine, unlike the drivers' mip levels.
[[nodiscard]] Image8 half_size(const Image8& image);

/// Errors: not a PNG, damaged, larger than `limit_texels`.
[[nodiscard]] Result<Image8> decode_png8(std::span<const std::byte> bytes,
                                         std::int64_t limit_texels = 1 << 28);
[[nodiscard]] Result<Image16> decode_png16(std::span<const std::byte> bytes,
                                           std::int64_t limit_texels = 1 << 28);
/// Lossless; RGB if every alpha is 255.
[[nodiscard]] Bytes encode_png(const Image8& image);
[[nodiscard]] Bytes encode_png(const Image16& image);
/// Lossless; empty if WebP cannot hold it (no texels, or more than 16383 a side).
[[nodiscard]] Bytes encode_webp(const Image8& image);
/// For viewing: `quality` 0 to 100, alpha ignored; empty as above.
[[nodiscard]] Bytes encode_lossy_webp(const Image8& image, float quality);
/// Errors: not a lossless still picture, damaged, larger than `limit_texels`.
[[nodiscard]] Result<Image8> decode_webp8(std::span<const std::byte> bytes,
                                          std::int64_t limit_texels = 1 << 28);
[[nodiscard]] bool begins_as_webp(std::span<const std::byte> bytes);
/// A picture's size from its first bytes; a few hundred suffice. Errors: neither PNG nor lossless WebP.
struct PictureExtent {
    std::int64_t width = 0, height = 0;
};
[[nodiscard]] Result<PictureExtent> extent_of_png(std::span<const std::byte> beginning);
[[nodiscard]] Result<PictureExtent> extent_of_webp(std::span<const std::byte> beginning);
/// Portable float map, three channels, little-endian, rows from bottom to top as in the format.
[[nodiscard]] Bytes encode_pfm(const ImageFloat& image);

/// True if some texel has alpha below one half: shaders do not draw such texels.
[[nodiscard]] inline bool has_cut_texels(const Image8& image) {
    return std::any_of(image.texels.begin(), image.texels.end(),
                       [](const glm::u8vec4& texel) { return texel.a < 128; });
}

} // namespace frustumscreen::image
