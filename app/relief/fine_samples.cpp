#include "app/relief/fine_samples.h"

#include "app/image/image.h"
#include "app/relief/lanes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace frustumscreen {

namespace {

/// Codes between neighbours that ask for more samples. On a pot's painted figures 8 take a fifth more rays than 24, and bring its
/// picture no nearer to the truth's.
constexpr std::uint8_t busy_codes = 24;

using Codes = std::uint8_t __attribute__((vector_size(4 * lanes)));

FRUSTUMSCREEN_INLINE Codes load_codes(const glm::u8vec4* from) {
    Codes codes;
    std::memcpy(&codes, from, sizeof codes);
    return codes;
}

/// Of eight pixels, not zero where a channel is far from the other's.
FRUSTUMSCREEN_INLINE Ints far(Codes a, Codes b) {
    const Codes off = (a > b ? a : b) - (a > b ? b : a);
    return reinterpret_cast<Ints>(off > busy_codes);
}

/// Sample k of n, a power of two: the k-th column and a row of its own in a grid of n x n, rows in the order of reversed bits
/// (Hammersley 1960), so that every edge of whatever slope passes one after another.
glm::vec2 sample_place(int k, int n) {
    int reversed = 0;
    for (int bit = 1, of = n / 2; bit < n; bit *= 2, of /= 2) {
        reversed += (k & bit) != 0 ? of : 0;
    }
    return (glm::vec2(k, reversed) + 0.5F) / static_cast<float>(n);
}

} // namespace

void LitCodes::begin(const PixelRectangle& lit) {
    lit_ = lit;
    stride_ = static_cast<std::size_t>(lit.width) + 2 * rim;
    stride_ += (lanes - stride_ % lanes) % lanes + lanes;
    codes_.assign(stride_ * static_cast<std::size_t>(lit.height + 2), glm::u8vec4(0));
    extents_.assign(static_cast<std::size_t>(lit.height + 2), {lit.width, 0});
}

LitCodes::Extent LitCodes::find_busy(int y, std::vector<std::int32_t>& busy) {
    Extent around{lit_.width, 0};
    for (int k = y - 1; k <= y + 1; ++k) {
        around = {std::min(around.first, extent(k).first), std::max(around.end, extent(k).end)};
    }
    around = {std::max(around.first - 1, 0) / tile_width * tile_width, std::min(around.end + 1, lit_.width)};
    const glm::u8vec4* const here = row(y);
    const glm::u8vec4* const above = here - stride_;
    const glm::u8vec4* const below = here + stride_;
    busy.resize(static_cast<std::size_t>(lit_.width) + lanes);
    for (int x = around.first; x < around.end; x += lanes) {
        const Codes at = load_codes(here + x);
        store(&busy[static_cast<std::size_t>(x)],
              far(at, load_codes(here + x - 1)) | far(at, load_codes(here + x + 1)) |
                  far(at, load_codes(above + x)) | far(at, load_codes(below + x)));
    }
    return around;
}

SampleLight::SampleLight() {
    for (std::size_t k = 0; k < linear_.size(); ++k) {
        linear_[k] =
            static_cast<std::uint16_t>(std::lround(65535.0 * static_cast<double>(linear_from_srgb8()[k])));
    }
    for (std::size_t k = 0; k < code_.size(); ++k) {
        code_[k] = srgb8_from_linear((static_cast<double>(k) + 0.5) / static_cast<double>(code_.size()));
    }
}

void FineBand::gather(LitCodes& codes, TileBand band, int samples) {
    const PixelRectangle& lit = codes.lit();
    const int first_column = lit.x / tile_width;
    const int columns = (lit.x + lit.width + tile_width - 1) / tile_width - first_column;
    rays_.begin(band, first_column, columns);
    pixels_.clear();
    for (int row = band.first; row < band.end; ++row) {
        const int rows = std::min(tile_height, lit.y + lit.height - row * tile_height);
        std::array<LitCodes::Extent, tile_height> extents;
        for (int j = 0; j < rows; ++j) {
            const auto of = static_cast<std::size_t>(j);
            extents[of] = codes.find_busy(row * tile_height + j, busy_[of]);
        }
        for (int column = 0; column < columns; ++column) {
            rays_.first.push_back(static_cast<std::uint32_t>(rays_.x.size() / lanes));
            for (int j = 0; j < rows; ++j) {
                const LitCodes::Extent& extent = extents[static_cast<std::size_t>(j)];
                const int end = std::min(column * tile_width + tile_width, extent.end);
                for (int x = std::max(column * tile_width, extent.first); x < end; ++x) {
                    if (busy_[static_cast<std::size_t>(j)][static_cast<std::size_t>(x)] == 0) {
                        continue;
                    }
                    const int y = row * tile_height + j;
                    pixels_.push_back({static_cast<std::uint16_t>(lit.x + x), static_cast<std::uint16_t>(y),
                                       static_cast<std::uint32_t>(rays_.x.size())});
                    for (int k = 0; k < samples; ++k) {
                        const glm::vec2 place = glm::vec2(lit.x + x, y) + sample_place(k, samples);
                        rays_.x.push_back(place.x);
                        rays_.y.push_back(place.y);
                    }
                }
            }
            while (rays_.x.size() % lanes != 0) {
                rays_.x.push_back(rays_.x.back());
                rays_.y.push_back(rays_.y.back());
            }
        }
    }
    rays_.first.push_back(static_cast<std::uint32_t>(rays_.x.size() / lanes));
}

void FineBand::resolve(const BlockRelief& relief, const SampleLight& light, int samples,
                       const PictureSpan<glm::u8vec4>& picture) const {
    for (const Pixel& pixel : pixels_) {
        glm::uvec3 sum(0);
        bool met = false;
        for (std::size_t k = pixel.first_ray; k < pixel.first_ray + static_cast<std::size_t>(samples); ++k) {
            if (rays_.t[k] < std::numeric_limits<float>::infinity()) {
                sum += light.light(colour_at(relief, rays_.block[k], rays_.place[k]));
                met = true;
            }
        }
        picture.at(pixel.x, pixel.y) = met ? light.mean(sum, static_cast<unsigned>(samples)) : glm::u8vec4(0);
    }
}

} // namespace frustumscreen
