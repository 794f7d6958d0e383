/// Collects shaped texts into glyph runs with one atlas of distances.
///
/// Threads  one caller.
/// Errors   a typeface's file that FreeType cannot read; more glyphs than an atlas can hold.
/// Library  FreeType draws the letters, without hinting.
#pragma once

#include "app/pack/glyph_runs.h"
#include "assets_baked/texts/shape.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::texts {

struct GlyphAtlasOptions {
    int texels_per_em = 48; ///< docs/measurements.md gives the reasons for both values
    int spread_texels = 2;
};

struct GlyphSheet {
    pack::GlyphRuns runs;
    pack::DistanceAtlas atlas;
};

class GlyphAtlasBuilder {
public:
    explicit GlyphAtlasBuilder(const GlyphAtlasOptions& options = {}) : options_(options) {}

    /// `key`: not used before, of the letters that `is_text_key` allows.
    void add(const std::string& key, const ShapedText& text);
    /// Draws the glyphs. Call once, last.
    [[nodiscard]] Result<GlyphSheet> finish();

private:
    [[nodiscard]] std::uint16_t number_of(const FontFace& face, std::uint32_t glyph);

    GlyphAtlasOptions options_;
    std::map<std::pair<FontFace, std::uint32_t>, std::size_t> numbers_;
    std::vector<std::pair<FontFace, std::uint32_t>> glyphs_; ///< in the order of their numbers
    std::vector<pack::GlyphText> texts_;
};

} // namespace frustumscreen::texts
