/// Sets text as a picture of its coverage: captions on the table, labels on sheets and patterns.
///
/// Text     UTF-8, composed characters (NFC), left to right; what is not UTF-8 shows as U+FFFD. Scripts that
///          run from right to left or join their letters need shaping, which is not there yet.
/// Units    pixels; `em_px` is the type size. Coverage 0..255, row 0 at the top.
/// Threads  one at a time (FreeType's faces are not shared). Offline or once for each caption, never in the
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

namespace frustumscreen {

struct Paragraph {
    std::string text;
    double em_px = 24.0;
    bool bold = false;
    double brightness = 1.0;      ///< of its letters, 0..1: scales the coverage
    double space_before_px = 0.0; ///< not above the first
};

class Typesetter {
public:
    /// DejaVu Sans in the places where Debian has it, or in `folder`.
    [[nodiscard]] static Result<Typesetter> open(const std::filesystem::path& folder = {});
    Typesetter(Typesetter&&) noexcept;
    Typesetter& operator=(Typesetter&&) noexcept;
    ~Typesetter();

    /// Lines broken at spaces so that they fit `width_px` (a longer word is broken where it must be); as wide
    /// as the widest line, at least 1 x 1. Letters that reach over the edge are not cut off.
    [[nodiscard]] Image<std::uint8_t> set(std::span<const Paragraph> paragraphs, double width_px) const;
    /// The size of that picture, without drawing it.
    [[nodiscard]] glm::ivec2 extent(std::span<const Paragraph> paragraphs, double width_px) const;
    /// One line.
    [[nodiscard]] Image<std::uint8_t> line(std::string_view text, double em_px, bool bold = false) const;
    /// Whether its letters are there, and are read as they are set: from left to right, one beside the other.
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

} // namespace frustumscreen
