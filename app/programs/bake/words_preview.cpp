#include "app/programs/bake/words_preview.h"

#include "app/typography/glyph_image.h"

#include <algorithm>

namespace frustumscreen::programs {

namespace {

constexpr double em_px = 20.0; ///< 24 pt under the shipped projector
constexpr double name_em_px = 36.0;
constexpr int gap_px = 14;
constexpr int column_px = 680;

struct PlacedImage {
    typography::GlyphImage image;
    int x = 0, y = 0;
};

/// Draws white on black, as the projector shows it.
void draw(const PlacedImage& placed, image::Image8& sheet) {
    const image::Image<std::uint8_t>& from = placed.image.coverage;
    for (int y = 0; y < from.height; ++y) {
        for (int x = 0; x < from.width; ++x) {
            const std::uint8_t code = image::srgb8_from_linear(from.at(x, y) / 255.0);
            if (code > 0) {
                sheet.at(placed.x + x, placed.y + y) = {code, code, code, 255};
            }
        }
    }
}

/// Lays out a language's words in a column, at settings that fit its width, and returns the column's height.
int lay_out(const pack::LanguageWords& words, int left, std::vector<PlacedImage>& placed) {
    int y = gap_px;
    for (const pack::GlyphText& text : words.runs.texts) {
        const double size = text.key == "name" ? name_em_px : em_px;
        const auto fits = [&](const pack::GlyphSetting& setting) {
            return setting.width * size / pack::em_units <= column_px;
        };
        const auto setting = std::find_if(text.settings.begin(), text.settings.end(), fits);
        if (setting == text.settings.end()) {
            continue;
        }
        typography::GlyphImage image = typography::glyph_image(words.runs, words.atlas, *setting, size);
        const bool flush_right = text.direction == pack::TextDirection::RightToLeft;
        const int x = flush_right ? left + column_px - image.coverage.width : left;
        const int height = image.coverage.height;
        placed.push_back({std::move(image), x, y});
        y += height + gap_px / 2;
    }
    return y + gap_px;
}

} // namespace

image::Image8 words_preview(std::span<const pack::LanguageWords> languages) {
    std::vector<PlacedImage> placed;
    int height = 1;
    int left = gap_px;
    for (const pack::LanguageWords& words : languages) {
        height = std::max(height, lay_out(words, left, placed));
        left += column_px + 3 * gap_px;
    }
    image::Image8 sheet(left, height, {0, 0, 0, 255});
    for (const PlacedImage& image : placed) {
        draw(image, sheet);
    }
    return sheet;
}

} // namespace frustumscreen::programs
