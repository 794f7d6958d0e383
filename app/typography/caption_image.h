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
#include <cstdint>
#include <span>
#include <string>

namespace frustumscreen::typography {

/// Widths that a caption is wrapped to, preferred ones first.
inline constexpr std::array<double, 3> caption_widths_m{0.30, 0.16, 0.075};
/// A title's type size, relative to the text's.
inline constexpr double caption_title_em = 1.35;
/// Brightness of the text relative to the title's, linear: slightly dimmer.
inline constexpr double caption_text_brightness = 0.8;
/// Type size of the lines below the text, in those of the text; they too have at least 24 pt.
inline constexpr double caption_small_em = 0.8;

/// The type style of a caption's part.
enum class CaptionRole : std::uint8_t {
    Title, ///< larger and bold
    Text,
    Small, ///< as the text, in small type; a line of them follows the one before without a gap
};
struct PlainPart {
    CaptionRole role = CaptionRole::Text;
    std::string text;
};
struct GlyphPart {
    CaptionRole role = CaptionRole::Text;
    const pack::GlyphText* text = nullptr; ///< of the runs; null: omitted
};

struct CaptionImage {
    image::Image<std::uint8_t> coverage;
    glm::dvec2 size_m{0.0}; ///< along X and Y of the table
};

/// The parts, one below the other, wrapped to `width_m`. `em_m` is the text's type size; less than 24 pt
/// (`min_caption_em_m`) becomes 24 pt.
[[nodiscard]] CaptionImage make_caption(const Typesetter& typesetter, std::span<const PlainPart> parts,
                                        double em_m, double width_m, double texels_per_m);

/// The caption from texts that the bake has shaped: without a typeface, in any script. A paragraph that runs
/// to the left is flush right. Each part uses the widest of its settings that fits `width_m`, else the
/// narrowest.
[[nodiscard]] CaptionImage make_caption(const pack::GlyphRuns& runs, const pack::DistanceAtlas& atlas,
                                        std::span<const GlyphPart> parts, double em_m, double width_m,
                                        double texels_per_m);

/// The `size_m` of these captions, without drawing.
[[nodiscard]] glm::dvec2 caption_size_m(const Typesetter& typesetter, std::span<const PlainPart> parts,
                                        double em_m, double width_m, double texels_per_m);
[[nodiscard]] glm::dvec2 caption_size_m(const pack::GlyphRuns& runs, std::span<const GlyphPart> parts,
                                        double em_m, double width_m, double texels_per_m);

} // namespace frustumscreen::typography
