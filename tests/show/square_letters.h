// Set texts whose only letter is a filled square, as large as the type size.
#pragma once

#include "app/pack/pack_texts.h"

#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::synthetic {

inline pack::SetLanguage set_in_squares(const std::string& language, std::vector<pack::GlyphText> texts) {
    pack::SetLanguage set{language, {}, pack::DistanceAtlas(12, 12, 255)};
    set.runs.texels_per_em = 8;
    set.runs.spread_texels = 1;
    set.runs.atlas_width = set.runs.atlas_height = 12;
    set.runs.boxes = {{2, 2, 8, 8, 0, 8}};
    set.runs.texts = std::move(texts);
    return set;
}

} // namespace frustumscreen::synthetic
