#include "app/typography/caption_image.h"

#include "app/typography/captions.h"
#include "app/typography/coverage.h"
#include "app/typography/glyph_image.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen {

namespace {

constexpr double text_gap_em = 0.3; ///< between title and text

/// A title or a text.
struct SetPart {
    const GlyphSetting* setting = nullptr;
    double em_px = 0.0;
    double brightness = 1.0;
    TextDirection direction = TextDirection::LeftToRight;
    GlyphExtent extent;
};

/// Parts, one below the other.
struct SetParts {
    std::vector<SetPart> parts;
    int gap_px = 0; ///< between two parts
    int width_px = 1, height_px = 0;
};

SetParts lay_out(const GlyphRuns& runs, const GlyphText* title, const GlyphText* text, double em_m,
                 double width_m, double texels_per_m) {
    const double em_px = std::max(em_m, least_caption_em_m) * texels_per_m;
    const double width_em = width_m * texels_per_m / em_px;
    SetParts all;
    all.gap_px = static_cast<int>(std::lround(text_gap_em * em_px));
    const auto add = [&](const GlyphText* part, double em, double brightness) {
        if (const GlyphSetting* setting = fitting_setting(part, width_em / em)) {
            const GlyphExtent extent = glyph_extent(runs, *setting, em * em_px);
            all.width_px = std::max(all.width_px, extent.width_px);
            all.height_px += (all.height_px > 0 ? all.gap_px : 0) + extent.height_px;
            all.parts.push_back({setting, em * em_px, brightness, part->direction, extent});
        }
    };
    add(title, caption_title_em, 1.0);
    add(text, 1.0, caption_text_brightness);
    all.height_px = std::max(all.height_px, 1);
    return all;
}

std::vector<Paragraph> paragraphs_of(const std::string& title, const std::string& text, double em_px) {
    std::vector<Paragraph> paragraphs;
    if (!title.empty()) {
        paragraphs.push_back({title, caption_title_em * em_px, true, 1.0, 0.0});
    }
    if (!text.empty()) {
        paragraphs.push_back({text, em_px, false, caption_text_brightness, text_gap_em * em_px});
    }
    return paragraphs;
}

} // namespace

CaptionImage make_caption(const Typesetter& typesetter, const std::string& title, const std::string& text,
                          double em_m, double width_m, double texels_per_m) {
    const double em_px = std::max(em_m, least_caption_em_m) * texels_per_m;
    CaptionImage caption;
    caption.coverage = typesetter.set(paragraphs_of(title, text, em_px), width_m * texels_per_m);
    caption.size_m = glm::dvec2(caption.coverage.width, caption.coverage.height) / texels_per_m;
    return caption;
}

CaptionImage make_caption(const GlyphRuns& runs, const DistanceAtlas& atlas, const GlyphText* title,
                          const GlyphText* text, double em_m, double width_m, double texels_per_m) {
    const SetParts set = lay_out(runs, title, text, em_m, width_m, texels_per_m);
    CaptionImage caption;
    caption.coverage = Image<std::uint8_t>(set.width_px, set.height_px);
    int top = 0;
    for (const SetPart& part : set.parts) {
        const bool flush_right = part.direction == TextDirection::RightToLeft;
        draw_lighter(glyph_image(runs, atlas, *part.setting, part.em_px).coverage, part.brightness,
                     flush_right ? set.width_px - part.extent.width_px : 0, top, caption.coverage);
        top += part.extent.height_px + set.gap_px;
    }
    caption.size_m = glm::dvec2(caption.coverage.width, caption.coverage.height) / texels_per_m;
    return caption;
}

glm::dvec2 caption_size_m(const Typesetter& typesetter, const std::string& title, const std::string& text,
                          double em_m, double width_m, double texels_per_m) {
    const double em_px = std::max(em_m, least_caption_em_m) * texels_per_m;
    return glm::dvec2(typesetter.extent(paragraphs_of(title, text, em_px), width_m * texels_per_m)) /
           texels_per_m;
}

glm::dvec2 caption_size_m(const GlyphRuns& runs, const GlyphText* title, const GlyphText* text, double em_m,
                          double width_m, double texels_per_m) {
    const SetParts set = lay_out(runs, title, text, em_m, width_m, texels_per_m);
    return glm::dvec2(set.width_px, set.height_px) / texels_per_m;
}

} // namespace frustumscreen
