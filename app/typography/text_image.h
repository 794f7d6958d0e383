/// Sets text as a picture of its coverage: captions on the table, labels on sheets and patterns.
///
/// Text     UTF-8, composed characters (NFC), left to right; invalid UTF-8 shows as U+FFFD. Scripts that run
///          from right to left or join their letters need shaping, which only the bake does
///          (app/pack/glyph_runs.h).
/// Units    pixels; `em_px` is the type size. Coverage 0..255, row 0 at the top.
/// Threads  one at a time (FreeType's faces are not shared). Offline or once for each caption, never in a
///          frame.
/// Errors   the typeface's files are missing or unreadable.
/// Library  FreeType 2, grey coverage without hinting, pen positions to 1/64 pixel.
#pragma once

#include "app/image/image.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace frustumscreen::typography {

struct Paragraph {
    std::string text;
    double em_px = 24.0;
    bool bold = false;
    double brightness = 1.0;      ///< of its letters, 0..1: scales the coverage
    double space_before_px = 0.0; ///< ignored for the first paragraph
};

class Typesetter {
public:
    /// Opens DejaVu Sans from Debian's folders, or from `folder`.
    [[nodiscard]] static Result<Typesetter> open(const std::filesystem::path& folder = {});
    Typesetter(Typesetter&&) noexcept;
    Typesetter& operator=(Typesetter&&) noexcept;
    ~Typesetter();

    /// Lines are broken at spaces to fit `width_px` (a longer word is broken inside). The picture is as wide
    /// as the widest line, at least 1 x 1. Letters that extend beyond the edge are not cut off.
    [[nodiscard]] image::Image<std::uint8_t> set(std::span<const Paragraph> paragraphs,
                                                 double width_px) const;
    /// The size of that picture, without drawing.
    [[nodiscard]] glm::ivec2 extent(std::span<const Paragraph> paragraphs, double width_px) const;
    /// One line.
    [[nodiscard]] image::Image<std::uint8_t> line(std::string_view text, double em_px,
                                                  bool bold = false) const;
    /// True if the typeface has its letters, and they need no shaping: left to right, one after another.
    [[nodiscard]] bool can_set(std::string_view text) const;
    /// From the top of a picture to the first line's baseline.
    static constexpr double ascent_em = 0.95;
    /// Distance from one line's baseline to the next.
    static constexpr double line_pitch_em = 1.28;

private:
    struct Faces;
    struct Layout;
    [[nodiscard]] Layout lay_out(std::span<const Paragraph> paragraphs, double width_px) const;
    explicit Typesetter(std::unique_ptr<Faces> faces);
    std::unique_ptr<Faces> faces_;
};

} // namespace frustumscreen::typography
