/// A caption's text as a picture to lay on the table.
///
/// Units    metres on the table. Coverage is linear light, 255 = white; row 0 at the text's top.
/// Threads  as Typesetter; made once for each text, language and size.
#pragma once

#include "app/image/image.h"
#include "app/pack/glyph_runs.h"
#include "app/typography/text_image.h"

#include <glm/glm.hpp>

#include <array>
#include <string>

namespace frustumscreen {

/// Widths that a caption is wrapped to, preferred ones first.
inline constexpr std::array<double, 3> caption_widths_m{0.30, 0.16, 0.075};
/// A title's type size, relative to the text's.
inline constexpr double caption_title_em = 1.35;
/// Brightness of the text relative to the title's, linear: slightly dimmer.
inline constexpr double caption_text_brightness = 0.8;

struct CaptionImage {
    Image<std::uint8_t> coverage;
    glm::dvec2 size_m{0.0}; ///< along X and Y of the table
};

/// The title, larger and bold, above the text, wrapped to `width_m`. `em_m` is the text's type size, at least
/// 24 pt (`least_caption_em_m`).
[[nodiscard]] CaptionImage make_caption(const Typesetter& typesetter, const std::string& title,
                                        const std::string& text, double em_m, double width_m,
                                        double texels_per_m);

/// As above, for texts that the bake has shaped: without a typeface, in any script. A paragraph that runs
/// from right to left is flush right. `title` and `text` are texts of `runs`, or null; each uses the widest
/// of its settings that fits `width_m`, otherwise the narrowest.
[[nodiscard]] CaptionImage make_caption(const GlyphRuns& runs, const DistanceAtlas& atlas,
                                        const GlyphText* title, const GlyphText* text, double em_m,
                                        double width_m, double texels_per_m);

/// The `size_m` of each of these, without drawing.
[[nodiscard]] glm::dvec2 caption_size_m(const Typesetter& typesetter, const std::string& title,
                                        const std::string& text, double em_m, double width_m,
                                        double texels_per_m);
[[nodiscard]] glm::dvec2 caption_size_m(const GlyphRuns& runs, const GlyphText* title, const GlyphText* text,
                                        double em_m, double width_m, double texels_per_m);

} // namespace frustumscreen
