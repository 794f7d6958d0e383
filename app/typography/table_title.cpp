#include "app/typography/table_title.h"

#include "app/typography/captions.h"
#include "app/typography/coverage.h"
#include "app/typography/glyph_image.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace frustumscreen::typography {

namespace {

constexpr std::size_t max_lines = 2;
constexpr double fades_over_em = 1.5;
/// Two lines together are 22 mm high, like a place's title (TableSetUp::title_m).
constexpr double first_baseline_em = 1.0;
constexpr double line_pitch_em = 1.2;
constexpr double below_baseline_em = 0.38;

using Coverage = image::Image<std::uint8_t>;

/// A run of glyphs without a space: [first, end) in the line's order.
struct Word {
    std::size_t first = 0;
    std::size_t end = 0;
};

std::vector<Word> words_of(const pack::GlyphRuns& runs, const pack::GlyphSetting& line) {
    std::vector<Word> words;
    bool within = false;
    for (std::size_t k = 0; k < line.glyphs.size(); ++k) {
        const bool space = runs.boxes[line.glyphs[k].glyph].width == 0;
        if (!space && !within) {
            words.push_back({k, k + 1});
        } else if (!space) {
            words.back().end = k + 1;
        }
        within = !space;
    }
    return words;
}

/// Approximate width of the glyphs [first, end).
double width_of(const pack::GlyphRuns& runs, const pack::GlyphSetting& line, std::size_t first,
                std::size_t end) {
    const pack::GlyphBox& last = runs.boxes[line.glyphs[end - 1].glyph];
    return line.glyphs[end - 1].x - line.glyphs[first].x +
           static_cast<double>(last.left + last.width) * pack::em_units /
               std::max<int>(runs.texels_per_em, 1);
}

pack::GlyphSetting part_of(const pack::GlyphSetting& line, std::size_t first, std::size_t end) {
    pack::GlyphSetting part{
        .limit = line.limit, .width = line.width, .height = line.height, .lines = line.lines, .glyphs = {}};
    part.glyphs.assign(line.glyphs.begin() + static_cast<std::ptrdiff_t>(first),
                       line.glyphs.begin() + static_cast<std::ptrdiff_t>(end));
    part.lines.front().glyphs = static_cast<std::uint32_t>(part.glyphs.size());
    return part;
}

/// Breaks a line in two of about equal width, so that the longer one is as short as possible; empty without a
/// space.
std::vector<pack::GlyphSetting> broken_in_two(const pack::GlyphRuns& runs, const pack::GlyphSetting& line,
                                              bool to_the_left) {
    const std::vector<Word> words = words_of(runs, line);
    std::vector<pack::GlyphSetting> best;
    double best_width = 0.0;
    for (std::size_t k = 1; k < words.size(); ++k) {
        const double width = std::max(width_of(runs, line, words.front().first, words[k - 1].end),
                                      width_of(runs, line, words[k].first, words.back().end));
        if (best.empty() || width < best_width) {
            best_width = width;
            best = {part_of(line, words.front().first, words[k - 1].end),
                    part_of(line, words[k].first, words.back().end)};
        }
    }
    if (to_the_left) {
        std::reverse(best.begin(), best.end());
    }
    return best;
}

/// Each line by itself, as a setting of the same box.
std::vector<pack::GlyphSetting> lines_of(const pack::GlyphSetting& setting) {
    std::vector<pack::GlyphSetting> lines;
    auto glyph = setting.glyphs.begin();
    for (const pack::GlyphLine& line : setting.lines) {
        const auto end = glyph + static_cast<std::ptrdiff_t>(line.glyphs);
        lines.push_back({.limit = setting.limit,
                         .width = setting.width,
                         .height = setting.height,
                         .lines = {line},
                         .glyphs = {glyph, end}});
        glyph = end;
    }
    return lines;
}

/// The setting with the fewest lines that fits. If two lines do not hold the title, its single line is broken
/// in the middle, so that the least text is cut off.
std::vector<pack::GlyphSetting> best_lines(const pack::GlyphRuns& runs, const pack::GlyphText& title,
                                           double width) {
    const pack::GlyphSetting* fits = nullptr;
    const pack::GlyphSetting* single = nullptr;
    const pack::GlyphSetting* narrowest = nullptr;
    for (const pack::GlyphSetting& setting : title.settings) {
        const std::size_t lines = setting.lines.size();
        if (setting.width <= width && lines <= max_lines && (!fits || lines < fits->lines.size())) {
            fits = &setting;
        }
        single = lines == 1 ? &setting : single;
        narrowest = narrowest == nullptr || setting.width < narrowest->width ? &setting : narrowest;
    }
    if (fits == nullptr && single != nullptr) {
        std::vector<pack::GlyphSetting> two =
            broken_in_two(runs, *single, title.direction == pack::TextDirection::RightToLeft);
        if (!two.empty()) {
            return two;
        }
    }
    const pack::GlyphSetting* const setting = fits != nullptr ? fits : narrowest;
    return setting != nullptr ? lines_of(*setting) : std::vector<pack::GlyphSetting>();
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

/// A line's letters, and the row of `image` that holds their baseline.
struct SetLine {
    Coverage image;
    int baseline = 0;
};

/// Lines have the same pitch in every script, so that two always fit a place.
CaptionImage in_the_middle(const std::vector<SetLine>& lines, double em_px, double texels_per_m) {
    int width = 1;
    for (const SetLine& line : lines) {
        width = std::max(width, line.image.width);
    }
    const double rows = first_baseline_em + below_baseline_em +
                        line_pitch_em * static_cast<double>(std::max<std::size_t>(lines.size(), 1) - 1);
    const int height = static_cast<int>(std::ceil(rows * em_px));
    CaptionImage title{Coverage(width, height), glm::dvec2(width, height) / texels_per_m};
    double baseline = first_baseline_em * em_px;
    for (const SetLine& line : lines) {
        const int left = (width - line.image.width) / 2;
        const int top = static_cast<int>(std::lround(baseline)) - line.baseline;
        for (int y = std::max(0, -top); y < std::min(line.image.height, height - top); ++y) {
            for (int x = 0; x < line.image.width; ++x) {
                std::uint8_t& texel = title.coverage.at(left + x, top + y);
                texel = std::max(texel, line.image.at(x, y));
            }
        }
        baseline += line_pitch_em * em_px;
    }
    return title;
}

/// Signed distance of a point from a square with round corners, in its half sides; negative inside.
double outside_square(const glm::dvec2& at) {
    constexpr double radius = 0.12;
    constexpr double half = 0.97;
    const glm::dvec2 off = glm::abs(at) - (half - radius);
    return glm::length(glm::max(off, 0.0)) + std::min(std::max(off.x, off.y), 0.0) - radius;
}

/// `outside`: signed distance of a point from the shape, in half sides.
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

CaptionImage make_table_title(const pack::GlyphRuns& runs, const pack::DistanceAtlas& atlas,
                              const pack::GlyphText& title, double texels_per_m) {
    const double em_px = min_caption_em_m * texels_per_m;
    const int width_px = static_cast<int>(table_title_width_m * texels_per_m);
    const bool to_the_left = title.direction == pack::TextDirection::RightToLeft;
    const std::vector<pack::GlyphSetting> lines = best_lines(runs, title, width_px / em_px * pack::em_units);
    std::vector<SetLine> set;
    for (std::size_t k = 0; k < std::min(lines.size(), max_lines); ++k) {
        const GlyphImage image = glyph_image(runs, atlas, lines[k], em_px);
        const double baseline_px = lines[k].lines.front().baseline * em_px / pack::em_units;
        SetLine line{trimmed(image.coverage), image.top_px + static_cast<int>(std::lround(baseline_px))};
        if (line.image.width > width_px || (k + 1 == max_lines && lines.size() > max_lines)) {
            line.image = cut_off(line.image, width_px, static_cast<int>(std::lround(fades_over_em * em_px)),
                                 to_the_left);
        }
        set.push_back(std::move(line));
    }
    return in_the_middle(set, em_px, texels_per_m);
}

CaptionImage make_table_title(const Typesetter& typesetter, const std::string& title, double texels_per_m) {
    const double em_px = min_caption_em_m * texels_per_m;
    const std::vector<Paragraph> paragraphs{{title, em_px, true, 1.0, 0.0}};
    Coverage text = typesetter.set(paragraphs, table_title_width_m * texels_per_m);
    const double max_px = std::ceil(max_lines * Typesetter::line_pitch_em * em_px);
    text.height = std::min(text.height, static_cast<int>(max_px));
    text.texels.resize(static_cast<std::size_t>(text.width) * static_cast<std::size_t>(text.height));
    const glm::dvec2 size_m = glm::dvec2(text.width, text.height) / texels_per_m;
    return {std::move(text), size_m};
}

image::Image<std::uint8_t> outlined_square(int side_px) {
    return drawn(side_px, [](const glm::dvec2& at) { return std::abs(outside_square(at)) - half_line; });
}

image::Image<std::uint8_t> more_mark(int side_px) {
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

} // namespace frustumscreen::typography
