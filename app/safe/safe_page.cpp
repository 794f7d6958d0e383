#include "app/safe/safe_page.h"

#include "firmware_host/base/printable.h"
#include "firmware_host/base/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>

namespace frustumscreen::safe {

namespace {

constexpr std::uint8_t visitors_grey = 235, reason_grey = 190, staff_grey = 160, machine_grey = 110;
constexpr char32_t unknown_letter = U'\uFFFD', ellipsis = U'\u2026';
constexpr std::size_t max_reason_lines = 4;
constexpr std::string_view no_reason = "No reason was given.";

/// Shares of the picture.
constexpr double margin_of_side = 0.05;       ///< of the shorter side, on all edges
constexpr double visitors_of_height = 0.52;   ///< at most
constexpr double largest_type_of_side = 0.08; ///< of the shorter side; for a single language
constexpr double staff_type_of_side = 0.026; ///< of the shorter side: more than 24 points on a table of 0.5 m
constexpr double staff_type_of_visitors = 0.8; ///< at most
constexpr double visitors_pitch_em = 1.5;      ///< for every script
constexpr double longest_line_em = 56.0;       ///< for the staff; longer lines are hard to read
constexpr double shrink = 0.94;                ///< factor between two attempts

const BakedLetter* letter_of(char32_t character) {
    const std::span<const BakedLetter> letters = safe_words().letters;
    const auto found = std::lower_bound(
        letters.begin(), letters.end(), character,
        [](const BakedLetter& letter, char32_t wanted) { return letter.character < wanted; });
    return found != letters.end() && found->character == character ? &*found : nullptr;
}

/// Every character of a shown reason has a letter.
std::int32_t width_of(std::u32string_view line) {
    std::int32_t width = 0;
    for (const char32_t character : line) {
        const BakedLetter* letter = letter_of(character);
        width += letter != nullptr ? letter->advance : 0;
    }
    return width;
}

/// `character`: one whole character, as from character_bytes.
char32_t code_point(std::string_view character) {
    const auto byte = [character](std::size_t k) { return static_cast<unsigned char>(character[k]); };
    char32_t code = character.size() == 1 ? byte(0) : byte(0) & (0x7FU >> character.size());
    for (std::size_t k = 1; k < character.size(); ++k) {
        code = (code << 6U) | (byte(k) & 0x3FU);
    }
    return code;
}

/// Number of characters of `text` in its first line: whole words if one fits, otherwise as many characters as
/// fit.
std::size_t first_line(std::u32string_view text, std::int32_t width) {
    std::size_t words = 0;
    std::size_t fits = 0;
    std::int32_t pen = 0;
    for (std::size_t k = 0; k <= text.size(); ++k) {
        if (k == text.size() || text[k] == U' ') {
            words = k;
        }
        pen += k < text.size() ? width_of(text.substr(k, 1)) : 0;
        if (k == text.size() || pen > width) {
            break;
        }
        fits = k + 1;
    }
    return std::max<std::size_t>(words > 0 ? words : fits, 1);
}

std::vector<std::u32string> broken_into_lines(std::u32string text, std::int32_t width) {
    std::vector<std::u32string> lines;
    while (!text.empty() && lines.size() < max_reason_lines) {
        const std::size_t count = first_line(text, width);
        lines.push_back(text.substr(0, count));
        text.erase(0, count);
        text.erase(0, text.find_first_not_of(U' '));
    }
    if (!text.empty()) {
        std::u32string& last = lines.back();
        while (!last.empty() && width_of(last + ellipsis) > width) {
            last.pop_back();
        }
        last += ellipsis;
    }
    return lines;
}

/// Sets texts one below the other, each centred.
class Column {
public:
    explicit Column(SafePage& page, double top_px) : page_(page), y_px_(top_px) {}

    void add(const BakedSetting& setting, double em_px, std::uint8_t grey) {
        const double scale = em_px / baked_em_units;
        const double left = (page_.width - setting.width * scale) / 2.0;
        for (const BakedGlyph& glyph : setting.glyphs) {
            place(glyph.box, left + glyph.x * scale, y_px_ + glyph.y * scale, em_px, grey);
        }
        y_px_ += setting.height * scale;
    }
    /// A single line with a fixed pitch, whatever the script's height.
    void add_row(const BakedSetting& line, double em_px, std::uint8_t grey) {
        const double top_px = y_px_;
        y_px_ += (safe_words().ascent - line.baseline) * em_px / baked_em_units;
        add(line, em_px, grey);
        y_px_ = top_px + visitors_pitch_em * em_px;
    }
    void add(std::u32string_view line, double em_px, std::uint8_t grey) {
        const double scale = em_px / baked_em_units;
        double x = (page_.width - width_of(line) * scale) / 2.0;
        for (const char32_t character : line) {
            if (const BakedLetter* letter = letter_of(character); letter != nullptr) {
                place(letter->box, x, y_px_ + safe_words().ascent * scale, em_px, grey);
                x += letter->advance * scale;
            }
        }
        y_px_ += safe_words().pitch * scale;
    }
    void leave(double px) { y_px_ += px; }
    [[nodiscard]] double y_px() const { return y_px_; }

private:
    void place(std::uint16_t box, double x, double y, double em_px, std::uint8_t grey) {
        page_.letters.push_back({.box = box,
                                 .x = static_cast<float>(x),
                                 .y = static_cast<float>(y),
                                 .em_px = static_cast<float>(em_px),
                                 .grey = grey});
    }
    SafePage& page_;
    double y_px_;
};

struct Sizes {
    double visitors_em_px = 0.0, staff_em_px = 0.0;
};

using Languages = std::vector<const BakedLanguage*>;

Sizes largest_sizes(int width, int height, const Languages& languages) {
    const double side = std::min(width, height);
    double widest_em = 1.0;
    for (const BakedLanguage* language : languages) {
        widest_em = std::max(widest_em, static_cast<double>(language->visitors.width) / baked_em_units);
    }
    const double height_em = visitors_pitch_em * static_cast<double>(languages.size());
    Sizes sizes;
    sizes.visitors_em_px = std::min({(width - 2.0 * margin_of_side * side) / widest_em,
                                     visitors_of_height * height / height_em, largest_type_of_side * side});
    sizes.staff_em_px = std::min(staff_type_of_side * side, staff_type_of_visitors * sizes.visitors_em_px);
    return sizes;
}

/// The widest setting that fits; otherwise the narrowest.
const BakedSetting& fitting(std::span<const BakedSetting> settings, double width_px, double em_px) {
    const auto fits = [&](const BakedSetting& setting) {
        return setting.width * em_px / baked_em_units <= width_px;
    };
    const auto found = std::find_if(settings.begin(), settings.end(), fits);
    return found != settings.end() ? *found : settings.back();
}

/// Returns the y of the bottom.
double set_page(SafePage& page, double top_px, const Sizes& sizes, const SafeText& text,
                const Languages& languages) {
    const double width_px = page.width - 2.0 * margin_of_side * std::min(page.width, page.height);
    Column column(page, top_px);
    for (const BakedLanguage* language : languages) {
        column.add_row(language->visitors, sizes.visitors_em_px, visitors_grey);
    }
    column.leave(1.5 * sizes.visitors_em_px);
    const double em_px = sizes.staff_em_px;
    const auto width =
        static_cast<std::int32_t>(std::min(width_px / em_px, longest_line_em) * baked_em_units);
    const std::u32string reason = shown_reason(text.reason);
    for (const std::u32string& line :
         broken_into_lines(reason.empty() ? shown_reason(no_reason) : reason, width)) {
        column.add(line, em_px, reason_grey);
    }
    column.leave(0.5 * em_px);
    column.add(fitting(languages.front()->for_staff, width_px, em_px), em_px, staff_grey);
    column.leave(0.5 * em_px);
    const std::string machine = fmt::format("FrustumScreen {}, {} since the computer was started",
                                            project_version(), in_hours(text.since_boot));
    for (const std::u32string& line : broken_into_lines(shown_reason(machine), width)) {
        column.add(line, em_px, machine_grey);
    }
    return column.y_px();
}

} // namespace

std::vector<std::string_view> safe_languages() {
    std::vector<std::string_view> names;
    for (const BakedLanguage& language : safe_words().languages) {
        names.push_back(language.language);
    }
    return names;
}

SafePage lay_out_safe_page(int width, int height, const SafeText& text,
                           const std::vector<std::string_view>& names) {
    Languages languages;
    for (const std::string_view name : names) {
        for (const BakedLanguage& language : safe_words().languages) {
            if (language.language == name) {
                languages.push_back(&language);
            }
        }
    }
    SafePage page{width, height, {}};
    if (languages.empty()) {
        return page;
    }
    const double max_px = height - 2.0 * margin_of_side * std::min(width, height);
    Sizes sizes = largest_sizes(width, height, languages);
    double height_px = set_page(page, 0.0, sizes, text, languages);
    for (int tries = 0; height_px > max_px && tries < 40; ++tries) {
        sizes = {sizes.visitors_em_px * shrink, sizes.staff_em_px * shrink};
        page.letters.clear();
        height_px = set_page(page, 0.0, sizes, text, languages);
    }
    page.letters.clear();
    set_page(page, (height - height_px) / 2.0, sizes, text, languages);
    return page;
}

std::u32string shown_reason(std::string_view bytes) {
    std::u32string shown;
    while (!bytes.empty() && bytes.front() != '\n' && shown.size() < longest_reason) {
        const std::size_t length = character_bytes(bytes);
        const std::string_view character = bytes.substr(0, std::max<std::size_t>(length, 1));
        bytes.remove_prefix(character.size());
        if (character == " " || character == "\t" || character == "\r") {
            if (!shown.empty() && shown.back() != U' ') {
                shown.push_back(U' ');
            }
            continue;
        }
        const char32_t code = length > 0 ? code_point(character) : unknown_letter;
        shown.push_back(letter_of(code) != nullptr ? code : unknown_letter);
    }
    if (!shown.empty() && shown.back() == U' ') {
        shown.pop_back();
    }
    return shown;
}

std::string in_hours(std::chrono::minutes time) {
    const auto minutes = time.count();
    return minutes < 60 ? fmt::format("{} min", minutes)
                        : fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

} // namespace frustumscreen::safe
