#include "app/exhibit/table_title.h"

#include "app/exhibit/captions.h"
#include "app/exhibit/glyph_image.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace frustumscreen {

namespace {

constexpr std::size_t most_lines = 2;
constexpr double fades_over_em = 1.5;

using Coverage = Image<std::uint8_t>;

/// The fewest lines that fit; else the narrowest setting.
const GlyphSetting* best_setting(const GlyphText& title, double width) {
    const GlyphSetting* best = nullptr;
    const auto order = [&](const GlyphSetting& setting) {
        const bool fits = setting.width <= width;
        return std::pair(fits ? 0 : 1,
                         fits ? static_cast<std::int64_t>(setting.lines.size()) : setting.width);
    };
    for (const GlyphSetting& setting : title.settings) {
        best = best == nullptr || order(setting) < order(*best) ? &setting : best;
    }
    return best;
}

/// Each line apart, as a setting of the same box.
std::vector<GlyphSetting> lines_of(const GlyphSetting& setting) {
    std::vector<GlyphSetting> lines;
    auto glyph = setting.glyphs.begin();
    for (const GlyphLine& line : setting.lines) {
        const auto end = glyph + static_cast<std::ptrdiff_t>(line.glyphs);
        lines.push_back({setting.limit, setting.width, setting.height, {line}, {glyph, end}});
        glyph = end;
    }
    return lines;
}

/// The columns from the first letter to the last.
Coverage trimmed(const Coverage& image) {
    int first = image.width;
    int last = -1;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            if (image.at(x, y) > 0) {
                first = std::min(first, x);
                last = std::max(last, x);
            }
        }
    }
    Coverage ink(std::max(last - first + 1, 1), image.height);
    for (int y = 0; y < image.height && last >= first; ++y) {
        for (int x = 0; x < ink.width; ++x) {
            ink.at(x, y) = image.at(first + x, y);
        }
    }
    return ink;
}

/// What is to the right of `width_px`, or to the left where the text runs there, is cut off.
Coverage cut(const Coverage& line, int width_px, int fade_px, bool to_the_left) {
    Coverage rest(std::min(line.width, width_px), line.height);
    const int skipped = to_the_left ? line.width - rest.width : 0;
    for (int y = 0; y < rest.height; ++y) {
        for (int x = 0; x < rest.width; ++x) {
            const int from_end = to_the_left ? x : rest.width - 1 - x;
            const double share = std::min(1.0, (from_end + 0.5) / std::max(fade_px, 1));
            rest.at(x, y) = static_cast<std::uint8_t>(std::lround(share * line.at(skipped + x, y)));
        }
    }
    return rest;
}

CaptionImage in_the_middle(const std::vector<Coverage>& lines, double texels_per_m) {
    int width = 1;
    int height = 1;
    for (const Coverage& line : lines) {
        width = std::max(width, line.width);
        height = std::max(height, line.height);
    }
    CaptionImage title{Coverage(width, height), glm::dvec2(width, height) / texels_per_m};
    for (const Coverage& line : lines) {
        const int left = (width - line.width) / 2;
        for (int y = 0; y < line.height; ++y) {
            for (int x = 0; x < line.width; ++x) {
                std::uint8_t& texel = title.coverage.at(left + x, y);
                texel = std::max(texel, line.at(x, y));
            }
        }
    }
    return title;
}

/// How far a place is outside a square with round corners, in its half sides; negative inside.
double outside_square(const glm::dvec2& at) {
    constexpr double radius = 0.12;
    constexpr double half = 0.97;
    const glm::dvec2 off = glm::abs(at) - (half - radius);
    return glm::length(glm::max(off, 0.0)) + std::min(std::max(off.x, off.y), 0.0) - radius;
}

/// `outside`: how far a place is outside what is drawn, in half sides.
template <typename Outside> Coverage drawn(int side_px, const Outside& outside) {
    Coverage image(side_px, side_px);
    const double half_px = 0.5 * side_px;
    for (int y = 0; y < side_px; ++y) {
        for (int x = 0; x < side_px; ++x) {
            const glm::dvec2 at = (glm::dvec2(x, y) + 0.5) / half_px - 1.0;
            const double share = std::clamp(0.5 - outside(at) * half_px, 0.0, 1.0);
            image.at(x, y) = static_cast<std::uint8_t>(std::lround(255.0 * share));
        }
    }
    return image;
}

constexpr double half_line = 0.012; ///< in half sides

} // namespace

CaptionImage make_table_title(const GlyphRuns& runs, const DistanceAtlas& atlas, const GlyphText& title,
                              double texels_per_m) {
    const double em_px = least_caption_em_m * texels_per_m;
    const int width_px = static_cast<int>(table_title_width_m * texels_per_m);
    const GlyphSetting* const setting = best_setting(title, width_px / em_px * em_units);
    std::vector<Coverage> images;
    if (setting != nullptr) {
        const std::vector<GlyphSetting> lines = lines_of(*setting);
        for (std::size_t k = 0; k < std::min(lines.size(), most_lines); ++k) {
            const Coverage line = trimmed(glyph_image(runs, atlas, lines[k], em_px).coverage);
            const bool goes_on = line.width > width_px || (k + 1 == most_lines && lines.size() > most_lines);
            images.push_back(goes_on ? cut(line, width_px, static_cast<int>(fades_over_em * em_px),
                                           title.direction == TextDirection::RightToLeft)
                                     : line);
        }
    }
    return in_the_middle(images, texels_per_m);
}

CaptionImage make_table_title(const Typesetter& typesetter, const std::string& title, double texels_per_m) {
    const double em_px = least_caption_em_m * texels_per_m;
    const std::vector<Paragraph> paragraphs{{title, em_px, true, 1.0, 0.0}};
    Coverage text = typesetter.set(paragraphs, table_title_width_m * texels_per_m);
    const double most_px = std::ceil(most_lines * Typesetter::line_pitch_em * em_px);
    text.height = std::min(text.height, static_cast<int>(most_px));
    text.texels.resize(static_cast<std::size_t>(text.width) * static_cast<std::size_t>(text.height));
    return in_the_middle({text}, texels_per_m);
}

Image<std::uint8_t> outlined_square(int side_px) {
    return drawn(side_px, [](const glm::dvec2& at) { return std::abs(outside_square(at)) - half_line; });
}

Image<std::uint8_t> more_mark(int side_px) {
    return drawn(side_px, [](const glm::dvec2& at) {
        constexpr double radius = 0.11;
        constexpr double pitch = 0.42;
        double dots = 1.0;
        for (const double x : {-pitch, 0.0, pitch}) {
            dots = std::min(dots, glm::distance(at, glm::dvec2(x, 0.0)) - radius);
        }
        return std::min(dots, std::abs(outside_square(at)) - half_line);
    });
}

} // namespace frustumscreen
