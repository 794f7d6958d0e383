// The exhibit's own texts with squares for letters, so that the letters of a picture can be counted.
#pragma once

#include "app/pack/words_file.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::synthetic {

/// The texts about a stick, each with its number of letters.
inline const std::vector<std::pair<std::string, int>>& stick_words() {
    static const std::vector<std::pair<std::string, int>> words{{"stick.found", 20},
                                                                {"stick.copying", 14},
                                                                {"stick.take_out", 12},
                                                                {"stick.stopped", 16},
                                                                {"stick.nothing_on_it", 15},
                                                                {"stick.taken", 3},
                                                                {"stick.already_there", 5},
                                                                {"stick.removed", 4},
                                                                {"stick.written", 19},
                                                                {"stick.not_written", 21},
                                                                {"stick.refused.unsigned", 8},
                                                                {"stick.refused.wrong_key", 9},
                                                                {"stick.refused.altered", 10},
                                                                {"stick.refused.older", 6},
                                                                {"stick.refused.not_a_pack", 7},
                                                                {"stick.refused.no_room", 11},
                                                                {"stick.refused.unreadable", 13},
                                                                {"stick.refused.unwritable", 17},
                                                                {"stick.refused.too_much", 18}};
    return words;
}

/// Letters half an em wide, an em apart, on the baseline; broken for 36, 18 and 9 em, as in the bake.
inline pack::LanguageWords block_words(const std::string& language, pack::TextDirection direction) {
    pack::LanguageWords all{language, language, {}, {}, pack::DistanceAtlas(12, 12, 255), {}};
    all.runs.texels_per_em = 8;
    all.runs.spread_texels = 1;
    all.runs.atlas_width = all.runs.atlas_height = 12;
    all.runs.boxes = {{2, 2, 4, 4, 0, 4}};
    for (const auto& [key, letters] : stick_words()) {
        pack::GlyphText text{key, direction, {}};
        for (const int limit : {36, 18, 9}) {
            pack::GlyphSetting setting{
                limit * pack::em_units, std::min(letters, limit) * pack::em_units, 0, {}, {}};
            for (int first = 0; first < letters; first += limit) {
                const int count = std::min(limit, letters - first);
                setting.lines.push_back({setting.height + pack::em_units, static_cast<std::uint32_t>(count)});
                for (int k = 0; k < count; ++k) {
                    setting.glyphs.push_back({0, 0, k * pack::em_units});
                }
                setting.height += pack::em_units + pack::em_units / 5;
            }
            text.settings.push_back(setting);
        }
        all.runs.texts.push_back(text);
        all.words.push_back({key, key, language});
    }
    return all;
}

} // namespace frustumscreen::synthetic
