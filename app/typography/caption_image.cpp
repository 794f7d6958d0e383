#include "app/typography/caption_image.h"

#include "app/typography/captions.h"
#include "app/typography/coverage.h"
#include "app/typography/glyph_image.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::typography {

namespace {

constexpr double text_gap_em = 0.3; ///< between title and text

/// Type size on the table, in those of the text.
double type_size(CaptionRole role, double em_m) {
    switch (role) {
    case CaptionRole::Title:
        return caption_title_em;
    case CaptionRole::Text:
        return 1.0;
    case CaptionRole::Small:
        break;
    }
    return std::max(caption_small_em * em_m, min_caption_em_m) / em_m;
}

double brightness_of(CaptionRole role) {
    return role == CaptionRole::Title ? 1.0 : caption_text_brightness;
}

/// Gap above a part, in type sizes of the text.
double gap_above(CaptionRole role, CaptionRole before) {
    return role == CaptionRole::Small && before == CaptionRole::Small ? 0.0 : text_gap_em;
}

struct SetPart {
    const pack::GlyphSetting* setting = nullptr;
    double em_px = 0.0;
    double brightness = 1.0;
    pack::TextDirection direction = pack::TextDirection::LeftToRight;
    GlyphExtent extent;
    int top_px = 0;
};

/// Parts, one below the other.
struct SetParts {
    std::vector<SetPart> parts;
    int width_px = 1, height_px = 0;
};

SetParts lay_out(const pack::GlyphRuns& runs, std::span<const GlyphPart> parts, double em_m, double width_m,
                 double texels_per_m) {
    const double text_em_m = std::max(em_m, min_caption_em_m);
    const double em_px = text_em_m * texels_per_m;
    const double width_em = width_m / text_em_m;
    SetParts all;
    CaptionRole before = CaptionRole::Title;
    for (const GlyphPart& part : parts) {
        const double em = type_size(part.role, text_em_m);
        const pack::GlyphSetting* const setting = fitting_setting(part.text, width_em / em);
        if (setting == nullptr) {
            continue;
        }
        const GlyphExtent extent = glyph_extent(runs, *setting, em * em_px);
        if (!all.parts.empty()) {
            all.height_px += static_cast<int>(std::lround(gap_above(part.role, before) * em_px));
        }
        all.parts.push_back({.setting = setting,
                             .em_px = em * em_px,
                             .brightness = brightness_of(part.role),
                             .direction = part.text->direction,
                             .extent = extent,
                             .top_px = all.height_px});
        all.width_px = std::max(all.width_px, extent.width_px);
        all.height_px += extent.height_px;
        before = part.role;
    }
    all.height_px = std::max(all.height_px, 1);
    return all;
}

std::vector<Paragraph> paragraphs_of(std::span<const PlainPart> parts, double em_m, double texels_per_m) {
    const double text_em_m = std::max(em_m, min_caption_em_m);
    const double em_px = text_em_m * texels_per_m;
    std::vector<Paragraph> paragraphs;
    CaptionRole before = CaptionRole::Title;
    for (const PlainPart& part : parts) {
        if (!part.text.empty()) {
            paragraphs.push_back({.text = part.text,
                                  .em_px = type_size(part.role, text_em_m) * em_px,
                                  .bold = part.role == CaptionRole::Title,
                                  .brightness = brightness_of(part.role),
                                  .space_before_px = gap_above(part.role, before) * em_px});
            before = part.role;
        }
    }
    return paragraphs;
}

} // namespace

CaptionImage make_caption(const Typesetter& typesetter, std::span<const PlainPart> parts, double em_m,
                          double width_m, double texels_per_m) {
    CaptionImage caption;
    caption.coverage = typesetter.set(paragraphs_of(parts, em_m, texels_per_m), width_m * texels_per_m);
    caption.size_m = glm::dvec2(caption.coverage.width, caption.coverage.height) / texels_per_m;
    return caption;
}

CaptionImage make_caption(const pack::GlyphRuns& runs, const pack::DistanceAtlas& atlas,
                          std::span<const GlyphPart> parts, double em_m, double width_m,
                          double texels_per_m) {
    const SetParts set = lay_out(runs, parts, em_m, width_m, texels_per_m);
    CaptionImage caption;
    caption.coverage = image::Image<std::uint8_t>(set.width_px, set.height_px);
    for (const SetPart& part : set.parts) {
        const bool flush_right = part.direction == pack::TextDirection::RightToLeft;
        draw_lighter(glyph_image(runs, atlas, *part.setting, part.em_px).coverage, part.brightness,
                     flush_right ? set.width_px - part.extent.width_px : 0, part.top_px, caption.coverage);
    }
    caption.size_m = glm::dvec2(caption.coverage.width, caption.coverage.height) / texels_per_m;
    return caption;
}

glm::dvec2 caption_size_m(const Typesetter& typesetter, std::span<const PlainPart> parts, double em_m,
                          double width_m, double texels_per_m) {
    return glm::dvec2(typesetter.extent(paragraphs_of(parts, em_m, texels_per_m), width_m * texels_per_m)) /
           texels_per_m;
}

glm::dvec2 caption_size_m(const pack::GlyphRuns& runs, std::span<const GlyphPart> parts, double em_m,
                          double width_m, double texels_per_m) {
    const SetParts set = lay_out(runs, parts, em_m, width_m, texels_per_m);
    return glm::dvec2(set.width_px, set.height_px) / texels_per_m;
}

} // namespace frustumscreen::typography
