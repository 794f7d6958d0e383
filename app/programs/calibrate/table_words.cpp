#include "app/programs/calibrate/table_words.h"

#include "app/typography/coverage.h"
#include "app/typography/glyph_image.h"

#include <algorithm>
#include <cctype>

namespace frustumscreen::programs {

void TableWords::add(std::string_view next_key, std::string_view line) {
    key = next_key.empty() ? key : next_key;
    if (!line.empty()) {
        lines.emplace_back(line);
    }
}

TableWords one_moment() {
    return {"calibration.all_taken", {"One moment, please."}};
}
TableWords all_kept() {
    return {"calibration.kept", {"The calibration is kept.", "The exhibit comes back with it."}};
}
TableWords all_unchanged() {
    return {"calibration.left", {"Nothing was changed.", "The exhibit comes back."}};
}
TableWords why_not(std::string_view title, std::string_view reason, std::string_view back) {
    return {"", {std::string(title), as_sentence(reason), std::string(back)}};
}

std::string as_sentence(std::string_view reason) {
    std::string sentence(reason);
    if (!sentence.empty()) {
        sentence.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence.front())));
        sentence += sentence.back() == '?' ? "" : ".";
    }
    return sentence;
}

std::vector<typography::Paragraph> paragraphs_of(const std::vector<std::string>& lines, double unit) {
    std::vector<typography::Paragraph> paragraphs;
    for (const std::string& line : lines) {
        const bool is_first = paragraphs.empty();
        paragraphs.push_back({.text = line,
                              .em_px = (is_first ? 4.0 : 2.6) * unit,
                              .bold = is_first,
                              .brightness = 1.0,
                              .space_before_px = is_first ? 0.0 : unit});
    }
    return paragraphs;
}

image::Image<std::uint8_t> sentence_above(const pack::LanguageWords* own_words, std::string_view key,
                                          double width_px, double width_em) {
    if (own_words == nullptr || own_words->language.starts_with("en")) {
        return {};
    }
    const double em_px = width_px / width_em;
    const pack::GlyphSetting* const setting =
        typography::fitting_setting(own_words->runs.find(key), width_em);
    return setting != nullptr
               ? typography::glyph_image(own_words->runs, own_words->atlas, *setting, em_px).coverage
               : image::Image<std::uint8_t>();
}

image::Image<std::uint8_t> above(const image::Image<std::uint8_t>& upper,
                                 const image::Image<std::uint8_t>& lower, double between_px) {
    if (upper.width == 0) {
        return lower;
    }
    const int top = upper.height + static_cast<int>(between_px);
    image::Image<std::uint8_t> both(std::max(upper.width, lower.width), top + lower.height);
    typography::draw_lighter(upper, 1.0, 0, 0, both);
    typography::draw_lighter(lower, 1.0, 0, top, both);
    return both;
}

void draw_dots(typography::Canvas& canvas, const glm::dvec2& middle, double unit, int count,
               const std::function<bool(int)>& is_done, const DotColours& colours) {
    for (int k = 0; k < count; ++k) {
        const bool done = is_done(k);
        canvas.circle(middle + glm::dvec2((k - 0.5 * (count - 1)) * 4.0 * unit, 0.0), unit, done ? 4.0 : 1.0,
                      done ? colours.done : colours.open);
    }
}

} // namespace frustumscreen::programs
