// Glyph runs: refused in one line, or written again they give the same bytes, and the kiosk can typeset them.
#include "app/pack/glyph_runs.h"
#include "app/typography/glyph_image.h"
#include "tests/fuzz/fuzz.h"

#include <algorithm>

using namespace frustumscreen;

namespace {

/// Small type keeps each input fast.
constexpr double em_px = 2.0;
constexpr std::size_t max_drawn_glyphs = 64;

bool is_quick(const pack::GlyphRuns& runs, const pack::GlyphSetting& setting) {
    const bool small = setting.glyphs.size() <= max_drawn_glyphs && setting.width <= 32 * pack::em_units &&
                       setting.height <= 32 * pack::em_units && runs.texels_per_em >= 8;
    return small && std::all_of(runs.boxes.begin(), runs.boxes.end(), [](const pack::GlyphBox& box) {
               return box.width <= 64 && box.height <= 64;
           });
}

void require_set(const pack::GlyphRuns& runs) {
    if (std::int64_t{runs.atlas_width} * runs.atlas_height > 1 << 16) {
        return;
    }
    const pack::DistanceAtlas atlas(runs.atlas_width, runs.atlas_height, 200);
    for (const pack::GlyphText& text : runs.texts) {
        for (const pack::GlyphSetting& setting : text.settings) {
            if (is_quick(runs, setting)) {
                const typography::GlyphImage image = typography::glyph_image(runs, atlas, setting, em_px);
                fuzz::require(image.left_px >= 0 && image.top_px >= 0, "a picture holds its box");
            }
        }
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = fuzz::bytes_of(data, size);
    const auto runs = pack::decode_glyph_runs(bytes);
    if (!runs) {
        fuzz::require_one_line(runs.error().message);
        return 0;
    }
    const Bytes written = pack::encode_glyph_runs(*runs);
    fuzz::require(std::equal(written.begin(), written.end(), bytes.begin(), bytes.end()),
                  "what was read is written again byte for byte");
    require_set(*runs);
    return 0;
}
