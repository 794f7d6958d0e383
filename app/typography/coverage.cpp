#include "app/typography/coverage.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::typography {

const pack::GlyphSetting* fitting_setting(const pack::GlyphText* text, double width_em) {
    const pack::GlyphSetting* widest = nullptr;
    const pack::GlyphSetting* narrowest = nullptr;
    if (text != nullptr) {
        for (const pack::GlyphSetting& setting : text->settings) {
            if (setting.width <= width_em * pack::em_units &&
                (widest == nullptr || setting.width > widest->width)) {
                widest = &setting;
            }
            if (narrowest == nullptr || setting.width < narrowest->width) {
                narrowest = &setting;
            }
        }
    }
    return widest != nullptr ? widest : narrowest;
}

void draw_lighter(const image::Image<std::uint8_t>& from, double brightness, int left, int top,
                  image::Image<std::uint8_t>& onto) {
    for (int y = 0; y < from.height; ++y) {
        for (int x = 0; x < from.width; ++x) {
            std::uint8_t& texel = onto.at(left + x, top + y);
            texel = std::max(texel, static_cast<std::uint8_t>(std::lround(brightness * from.at(x, y))));
        }
    }
}

image::Image<std::uint8_t> cut_off(const image::Image<std::uint8_t>& line, int width_px, int fade_px,
                                   bool to_the_left) {
    image::Image<std::uint8_t> rest(std::min(line.width, width_px), line.height);
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

} // namespace frustumscreen::typography
