#include "app/safe/draw_safe_page.h"

#include "app/image/image.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace frustumscreen::safe {

namespace {

constexpr int samples = 2; ///< along a pixel's side: small letters have strokes thinner than a pixel

/// A letter's rectangle in the picture.
struct Area {
    float left = 0.0F, top = 0.0F; ///< pixels
    float px_of_texel = 1.0F;
    const BakedBox* box = nullptr;
};

Area area_of(const PlacedLetter& letter, const SafeWords& words) {
    const BakedBox& box = words.boxes[letter.box];
    const float scale = letter.em_px / static_cast<float>(words.texels_per_em);
    return {.left = letter.x + static_cast<float>(box.left) * scale,
            .top = letter.y - static_cast<float>(box.top) * scale,
            .px_of_texel = scale,
            .box = &box};
}

/// The distance at (u, v) in the box, in texels from its top left; bilinear interpolation.
float distance_at(const SafeWords& words, const BakedBox& box, float u, float v) {
    u = std::clamp(u - 0.5F, 0.0F, static_cast<float>(box.width - 1));
    v = std::clamp(v - 0.5F, 0.0F, static_cast<float>(box.height - 1));
    const int left = static_cast<int>(u);
    const int top = static_cast<int>(v);
    const int right = std::min(left + 1, box.width - 1);
    const int bottom = std::min(top + 1, box.height - 1);
    const auto code = [&](int x, int y) {
        return static_cast<float>(
            words.atlas[static_cast<std::size_t>(box.y + y) * static_cast<std::size_t>(words.atlas_width) +
                        static_cast<std::size_t>(box.x + x)]);
    };
    const float along = u - static_cast<float>(left);
    const float upper = code(left, top) + (code(right, top) - code(left, top)) * along;
    const float lower = code(left, bottom) + (code(right, bottom) - code(left, bottom)) * along;
    return upper + (lower - upper) * (v - static_cast<float>(top));
}

/// The share of the pixel that the letter covers.
float cover(const SafeWords& words, const Area& area, int x, int y) {
    // Change of a sample's coverage per code of distance.
    const float of_code =
        area.px_of_texel * samples * static_cast<float>(words.spread_texels) / baked_outline_code;
    float sum = 0.0F;
    for (int k = 0; k < samples * samples; ++k) {
        const int row = k / samples;
        const int column = k % samples;
        const float px = static_cast<float>(x) + (static_cast<float>(column) + 0.5F) / samples;
        const float py = static_cast<float>(y) + (static_cast<float>(row) + 0.5F) / samples;
        const float code = distance_at(words, *area.box, (px - area.left) / area.px_of_texel,
                                       (py - area.top) / area.px_of_texel);
        sum += std::clamp(0.5F + (code - baked_outline_code) * of_code, 0.0F, 1.0F);
    }
    return sum / (samples * samples);
}

/// The sRGB code of each share of a grey's light, for shares of 1/255.
std::array<std::uint8_t, 256> shares_of(std::uint8_t grey) {
    const double light = image::linear_from_srgb(grey / 255.0);
    std::array<std::uint8_t, 256> codes{};
    for (std::size_t k = 0; k < codes.size(); ++k) {
        codes[k] = image::srgb8_from_linear(light * static_cast<double>(k) / 255.0);
    }
    return codes;
}

} // namespace

void draw_safe_rows(const SafePage& page, int first_row, std::span<std::uint8_t> greys) {
    assert(page.width > 0 && greys.size() % static_cast<std::size_t>(page.width) == 0);
    const SafeWords& words = safe_words();
    const int end_row = first_row + static_cast<int>(greys.size() / static_cast<std::size_t>(page.width));
    std::fill(greys.begin(), greys.end(), std::uint8_t{0});
    std::array<std::uint8_t, 256> codes{};
    int grey_of_codes = -1;
    for (const PlacedLetter& letter : page.letters) {
        const Area area = area_of(letter, words);
        const auto after = [&](float begin, std::uint16_t texels) {
            return static_cast<int>(std::ceil(begin + static_cast<float>(texels) * area.px_of_texel));
        };
        const int top = std::max(first_row, static_cast<int>(std::floor(area.top)));
        const int bottom = std::min(end_row, after(area.top, area.box->height));
        const int left = std::max(0, static_cast<int>(std::floor(area.left)));
        const int right = std::min(page.width, after(area.left, area.box->width));
        if (top >= bottom || left >= right || area.box->width == 0) {
            continue;
        }
        if (letter.grey != grey_of_codes) {
            codes = shares_of(letter.grey);
            grey_of_codes = letter.grey;
        }
        for (int y = top; y < bottom; ++y) {
            for (int x = left; x < right; ++x) {
                std::uint8_t& pixel =
                    greys[static_cast<std::size_t>(y - first_row) * static_cast<std::size_t>(page.width) +
                          static_cast<std::size_t>(x)];
                const auto share = static_cast<std::size_t>(std::lround(255.0F * cover(words, area, x, y)));
                pixel = std::max(pixel, codes[share]); // letters may overlap
            }
        }
    }
}

} // namespace frustumscreen::safe
