/// Shapes a text for several widths: lines broken by the language's rules, letters joined and stacked as in
/// its script, right-to-left order resolved.
///
/// Units    1/1024 em (`em_units`), as in app/pack/glyph_runs.h. Line pitch comes from the typefaces.
/// Errors   check_text.h; a language whose typeface is missing (fonts.h); a width out of range; more lines
///          than a setting may have. Losses that leave the text usable are notes: a letter that no typeface
///          has, a word wider than every width.
/// Threads  one caller.
/// Library  Pango with HarfBuzz, FriBidi and libthai.
#pragma once

#include "app/pack/glyph_runs.h"
#include "assets_baked/texts/fonts.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::texts {

inline constexpr std::size_t max_shaped_letters = 5000;

struct TextToShape {
    std::string text;
    std::string language; ///< BCP 47
    std::vector<std::int32_t>
        limits; ///< widths of the lines, at least one; a width too narrow for a word or with too many lines
                ///< is skipped
    bool bold = false;
};

/// A file of outlines; collections contain several faces.
struct FontFace {
    std::filesystem::path file;
    int index = 0;
    auto operator<=>(const FontFace&) const = default;
};

struct ShapedGlyph {
    std::uint32_t face = 0;  ///< index into the text's faces
    std::uint32_t glyph = 0; ///< glyph number in the face
    std::int32_t x = 0;
    std::int16_t up = 0;
};

struct ShapedSetting {
    std::int32_t limit = 0, width = 0, height = 0;
    std::vector<pack::GlyphLine> lines;
    std::vector<ShapedGlyph> glyphs;
};

struct ShapedText {
    pack::TextDirection direction = pack::TextDirection::LeftToRight;
    std::vector<FontFace> faces;
    std::vector<ShapedSetting> settings;
    std::vector<std::string> notes; ///< losses, a sentence each
};

class Shaper {
public:
    [[nodiscard]] static Result<Shaper> open();
    Shaper(Shaper&&) noexcept;
    Shaper& operator=(Shaper&&) noexcept;
    ~Shaper();

    [[nodiscard]] Result<ShapedText> shape(const TextToShape& text) const;
    [[nodiscard]] const Fonts& fonts() const { return fonts_; }

private:
    struct Engine;
    Shaper(Fonts fonts, std::unique_ptr<Engine> engine);
    Fonts fonts_;
    std::unique_ptr<Engine> engine_;
};

} // namespace frustumscreen::texts
