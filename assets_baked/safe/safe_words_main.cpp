/// frustumscreen-safe-words: bakes the safe picture's words into a C++ file (app/safe/safe_words.h). The
/// build runs it.
///
/// Errors   one line: a mistake in words.toml, or a missing typeface.
#include "app/pack/glyph_runs.h"
#include "app/programs/common/guarded_main.h"
#include "assets_baked/texts/glyph_atlas.h"
#include "assets_baked/texts/shape.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::safe {
namespace {

constexpr std::uintmax_t max_file_bytes = 1 << 20;
constexpr std::int32_t one_line = pack::glyph_limits::max_side;
constexpr std::array<std::int32_t, 5> staff_widths_em{46, 36, 28, 20, 14};

/// The characters that a reason may contain: Latin, and the punctuation of sentences.
constexpr std::array<std::pair<char32_t, char32_t>, 6> letter_ranges{
    {{0x20, 0x7E}, {0xA0, 0xAC}, {0xAE, 0x17F}, {0x2010, 0x2027}, {0x20AC, 0x20AC}, {0xFFFD, 0xFFFD}}};

struct LanguageToBake {
    std::string language, visitors, staff;
    std::int64_t line = 0; ///< in the file; the picture keeps the file's order
};

struct Letter {
    char32_t character = 0;
    std::string key;
    std::int32_t advance = 0;
};

Result<std::vector<LanguageToBake>> read_words(const std::string& file) {
    TRY(const Bytes bytes, read_file(file, max_file_bytes));
    std::vector<LanguageToBake> languages;
    try {
        const toml::table root = toml::parse(as_text(bytes));
        for (const auto& [language, node] : root) {
            const auto visitors = node.as_table() == nullptr
                                      ? std::nullopt
                                      : (*node.as_table())["visitors"].value<std::string>();
            const auto staff =
                node.as_table() == nullptr ? std::nullopt : (*node.as_table())["staff"].value<std::string>();
            if (!visitors || !staff) {
                return bad_input("safe_words.keys",
                                 "{}:{}: [{}] needs visitors = \"...\" and staff = \"...\"", file,
                                 node.source().begin.line, language.str());
            }
            languages.push_back({.language = std::string(language.str()),
                                 .visitors = *visitors,
                                 .staff = *staff,
                                 .line = node.source().begin.line});
        }
    } catch (const toml::parse_error& error) {
        return bad_input("safe_words.syntax", "{}:{}: is not TOML: {}", file, error.source().begin.line,
                         error.description());
    }
    std::sort(languages.begin(), languages.end(),
              [](const LanguageToBake& a, const LanguageToBake& b) { return a.line < b.line; });
    return languages;
}

std::string utf8(char32_t code) {
    const auto byte = [](char32_t bits) { return static_cast<char>(static_cast<unsigned char>(bits)); };
    if (code < 0x80) {
        return {byte(code)};
    }
    if (code < 0x800) {
        return {byte(0xC0 | (code >> 6)), byte(0x80 | (code & 0x3F))};
    }
    return {byte(0xE0 | (code >> 12)), byte(0x80 | ((code >> 6) & 0x3F)), byte(0x80 | (code & 0x3F))};
}

/// Collects everything that the picture may show in one atlas.
class WordsBaker {
public:
    explicit WordsBaker(const texts::Shaper& shaper) : shaper_(shaper) {}

    [[nodiscard]] Result<void> add(const LanguageToBake& language) {
        std::vector<std::int32_t> widths;
        for (const std::int32_t width : staff_widths_em) {
            widths.push_back(width * pack::em_units);
        }
        TRY_VOID(add("visitors." + language.language, language.visitors, language.language, {one_line}));
        return add("staff." + language.language, language.staff, language.language, widths);
    }

    /// A letter that the typeface lacks is skipped.
    [[nodiscard]] Result<void> add(char32_t character) {
        TRY(const texts::ShapedText alone, shaped(utf8(character)));
        TRY(const texts::ShapedText between, shaped("|" + utf8(character) + "|"));
        TRY(const texts::ShapedText bars, shaped("||"));
        if (alone.notes.empty()) {
            Letter letter{character, fmt::format("u{:04x}", static_cast<std::uint32_t>(character)), 0};
            // A space at the end of a line has no width, so the letter is measured between bars, which have
            // no kerning.
            letter.advance = between.settings.front().width - bars.settings.front().width;
            builder_.add(letter.key, alone);
            letters_.push_back(letter);
            ascent_ = bars.settings.front().lines.front().baseline;
            pitch_ = bars.settings.front().height;
        }
        return {};
    }

    [[nodiscard]] Result<std::string> as_cpp(const std::vector<LanguageToBake>& languages);

private:
    [[nodiscard]] Result<texts::ShapedText> shaped(const std::string& text) const {
        return shaper_.shape({.text = text, .language = "en", .limits = {one_line}, .bold = false});
    }
    [[nodiscard]] Result<void> add(const std::string& key, const std::string& text,
                                   const std::string& language, std::vector<std::int32_t> widths) {
        TRY(const texts::ShapedText shaped,
            at(key, shaper_.shape(
                        {.text = text, .language = language, .limits = std::move(widths), .bold = false})));
        if (!shaped.notes.empty()) {
            return bad_input("safe_words.letters", "{}: {}", key, shaped.notes.front());
        }
        builder_.add(key, shaped);
        return {};
    }

    const texts::Shaper& shaper_;
    texts::GlyphAtlasBuilder builder_;
    std::vector<Letter> letters_;
    std::int32_t ascent_ = 0, pitch_ = 0;
};

using Out = std::back_insert_iterator<std::string>;

/// Shift to the right that centres a line's ink in the box.
std::int32_t to_middle(const pack::GlyphRuns& runs, std::span<const pack::PlacedGlyph> line,
                       std::int32_t width) {
    std::int32_t left = width;
    std::int32_t right = 0;
    for (const pack::PlacedGlyph& glyph : line) {
        const pack::GlyphBox& box = runs.boxes[glyph.glyph];
        if (box.width > 0) {
            left = std::min(left, glyph.x + box.left * pack::em_units / runs.texels_per_em);
            right = std::max(right, glyph.x + (box.left + box.width) * pack::em_units / runs.texels_per_em);
        }
    }
    return left < right ? (width - left - right) / 2 : 0;
}

/// Writes a setting's glyphs as an array; returns the setting as an initialiser that names it.
std::string write_setting(std::string& cpp, const std::string& name, const pack::GlyphRuns& runs,
                          const pack::GlyphSetting& setting) {
    fmt::format_to(Out(cpp), "constexpr BakedGlyph {}[]{{", name);
    std::span<const pack::PlacedGlyph> rest = setting.glyphs;
    for (const pack::GlyphLine& line : setting.lines) {
        const std::span<const pack::PlacedGlyph> glyphs = rest.first(line.glyphs);
        rest = rest.subspan(line.glyphs);
        const std::int32_t shift = to_middle(runs, glyphs, setting.width);
        for (const pack::PlacedGlyph& glyph : glyphs) {
            fmt::format_to(Out(cpp), "{{{},{},{}}},", glyph.glyph, glyph.x + shift, line.baseline - glyph.up);
        }
    }
    cpp += "};\n";
    return fmt::format("{{{}, {}, {}, {}}}", setting.width, setting.height, setting.lines.front().baseline,
                       name);
}

void write_atlas(std::string& cpp, const pack::DistanceAtlas& atlas) {
    cpp += "constexpr unsigned char atlas[] =\n";
    for (int y = 0; y < atlas.height; ++y) {
        cpp += '"';
        for (int x = 0; x < atlas.width; ++x) {
            fmt::format_to(Out(cpp), "\\{:03o}", atlas.at(x, y));
        }
        cpp += "\"\n";
    }
    cpp += ";\n";
}

Result<std::string> WordsBaker::as_cpp(const std::vector<LanguageToBake>& languages) {
    TRY(const texts::GlyphSheet sheet, builder_.finish());
    const pack::GlyphRuns& runs = sheet.runs;
    std::string cpp = "// Made by frustumscreen-safe-words of assets_baked/safe/words.toml.\n"
                      "#include \"app/safe/safe_words.h\"\n\nnamespace frustumscreen::safe {\nnamespace {\n";
    write_atlas(cpp, sheet.atlas);
    cpp += "constexpr BakedBox boxes[]{\n";
    for (const pack::GlyphBox& box : runs.boxes) {
        fmt::format_to(Out(cpp), "{{{},{},{},{},{},{}}},\n", box.x, box.y, box.width, box.height, box.left,
                       box.top);
    }
    cpp += "};\nconstexpr BakedLetter letters[]{\n";
    for (const Letter& letter : letters_) {
        const pack::GlyphSetting& setting = runs.find(letter.key)->settings.front();
        if (setting.glyphs.size() == 1) {
            fmt::format_to(Out(cpp), "{{0x{:x},{},{}}},\n", static_cast<std::uint32_t>(letter.character),
                           setting.glyphs.front().glyph, letter.advance);
        }
    }
    cpp += "};\n";
    std::string list;
    for (std::size_t n = 0; n < languages.size(); ++n) {
        const std::string& language = languages[n].language;
        const std::string visitors = write_setting(cpp, fmt::format("visitors_{}", n), runs,
                                                   runs.find("visitors." + language)->settings.front());
        std::string settings;
        for (const pack::GlyphSetting& setting : runs.find("staff." + language)->settings) {
            settings += write_setting(cpp, fmt::format("staff_{}_{}", n, setting.limit / pack::em_units),
                                      runs, setting) +
                        ",\n";
        }
        fmt::format_to(Out(cpp), "constexpr BakedSetting staff_{}[]{{\n{}}};\n", n, settings);
        fmt::format_to(Out(list), "    {{\"{}\", {}, staff_{}}},\n", language, visitors, n);
    }
    fmt::format_to(
        Out(cpp),
        "constexpr BakedLanguage languages[]{{\n{}}};\n"
        "constexpr SafeWords words{{{}, {}, {}, {}, {}, {{atlas, sizeof atlas - 1}}, boxes, languages, "
        "letters}};\n}} // namespace\n\n"
        "const SafeWords& safe_words() {{\n    return words;\n}}\n\n}} // namespace frustumscreen::safe\n",
        list, runs.texels_per_em, runs.spread_texels, runs.atlas_width, ascent_, pitch_);
    return cpp;
}

Result<void> bake(const std::string& file, const std::string& out) {
    TRY(const std::vector<LanguageToBake> languages, read_words(file));
    TRY(const texts::Shaper shaper, texts::Shaper::open());
    WordsBaker baker(shaper);
    for (const LanguageToBake& language : languages) {
        TRY_VOID(baker.add(language));
    }
    for (const auto& [first, last] : letter_ranges) {
        for (char32_t character = first; character <= last; ++character) {
            TRY_VOID(baker.add(character));
        }
    }
    TRY(const std::string cpp, baker.as_cpp(languages));
    return write_file(out, as_bytes(cpp));
}

int run(int argc, char** argv) {
    if (argc != 3) {
        fmt::print(stderr, "usage: frustumscreen-safe-words WORDS.toml OUT.cpp\n");
        return 2;
    }
    return programs::exit_status("frustumscreen-safe-words", bake(argv[1], argv[2]));
}

} // namespace
} // namespace frustumscreen::safe

int main(int argc, char** argv) {
    return frustumscreen::programs::guarded_main("frustumscreen-safe-words", frustumscreen::safe::run, argc,
                                                 argv);
}
