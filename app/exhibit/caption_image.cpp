#include "app/exhibit/caption_image.h"

#include "app/exhibit/captions.h"
#include "app/exhibit/glyph_image.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen {

namespace {

constexpr double text_brightness = 0.8; ///< linear; a little behind the title

constexpr double text_gap_em = 0.3; ///< between title and text

struct SetPart {
    GlyphImage image;
    double brightness = 1.0;
    TextDirection direction = TextDirection::LeftToRight;
};

/// The widest setting that fits, else the narrowest; null without any.
const GlyphSetting* fitting(const GlyphText* text, double width_em) {
    const GlyphSetting* widest = nullptr;
    const GlyphSetting* narrowest = nullptr;
    if (text != nullptr) {
        for (const GlyphSetting& setting : text->settings) {
            if (setting.width <= width_em * em_units &&
                (widest == nullptr || setting.width > widest->width)) {
                widest = &setting;
            }
            if (narrowest == nullptr || setting.width < narrowest->width) {
                narrowest = &setting;
            }
        }
    }
    return widest != nullptr ? widest : narrowest;
}

/// Draws over what is there, lighter over darker.
void draw(const SetPart& part, int left, int top, Image<std::uint8_t>& caption) {
    const Image<std::uint8_t>& from = part.image.coverage;
    for (int y = 0; y < from.height; ++y) {
        for (int x = 0; x < from.width; ++x) {
            std::uint8_t& texel = caption.at(left + x, top + y);
            texel = std::max(texel, static_cast<std::uint8_t>(std::lround(part.brightness * from.at(x, y))));
        }
    }
}

} // namespace

CaptionImage make_caption(const Typesetter& typesetter, const std::string& title, const std::string& text,
                          double em_m, double width_m, double texels_per_m) {
    const double em_px = std::max(em_m, least_caption_em_m) * texels_per_m;
    std::vector<Paragraph> paragraphs;
    if (!title.empty()) {
        paragraphs.push_back({title, caption_title_em * em_px, true, 1.0, 0.0});
    }
    if (!text.empty()) {
        paragraphs.push_back({text, em_px, false, text_brightness, text_gap_em * em_px});
    }
    CaptionImage caption;
    caption.coverage = typesetter.set(paragraphs, width_m * texels_per_m);
    caption.size_m = glm::dvec2(caption.coverage.width, caption.coverage.height) / texels_per_m;
    return caption;
}

CaptionImage make_caption(const GlyphRuns& runs, const DistanceAtlas& atlas, const GlyphText* title,
                          const GlyphText* text, double em_m, double width_m, double texels_per_m) {
    const double em_px = std::max(em_m, least_caption_em_m) * texels_per_m;
    const double width_em = width_m * texels_per_m / em_px;
    std::vector<SetPart> parts;
    if (const GlyphSetting* setting = fitting(title, width_em / caption_title_em)) {
        parts.push_back(
            {glyph_image(runs, atlas, *setting, caption_title_em * em_px), 1.0, title->direction});
    }
    if (const GlyphSetting* setting = fitting(text, width_em)) {
        parts.push_back({glyph_image(runs, atlas, *setting, em_px), text_brightness, text->direction});
    }
    int width = 1;
    int height = 0;
    const int gap = static_cast<int>(std::lround(text_gap_em * em_px));
    for (const SetPart& part : parts) {
        width = std::max(width, part.image.coverage.width);
        height += (height > 0 ? gap : 0) + part.image.coverage.height;
    }
    CaptionImage caption;
    caption.coverage = Image<std::uint8_t>(width, std::max(height, 1));
    int top = 0;
    for (const SetPart& part : parts) {
        const bool flush_right = part.direction == TextDirection::RightToLeft;
        draw(part, flush_right ? width - part.image.coverage.width : 0, top, caption.coverage);
        top += part.image.coverage.height + gap;
    }
    caption.size_m = glm::dvec2(caption.coverage.width, caption.coverage.height) / texels_per_m;
    return caption;
}

} // namespace frustumscreen
