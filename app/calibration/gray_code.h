/// Which pixel of the projector lights what a camera sees: striped pictures to show, and what captures of them say.
///
/// For columns, then for rows: each bit of the Gray code of half a period's stripe, and its inverse; then a cosine of one period, shifted step by step.
/// Last a white picture and a black one. The cosine tells the place within its period to a fraction of a pixel; the Gray code tells which period, and as
/// its stripes are half as wide, one that is misread at a stripe's edge does no harm.
/// Gamma    n steps cancel the harmonics 2 to n - 2 of whatever projector and camera do to the cosine.
/// Units    pixels, the centre of the top left one is (0.5, 0.5), of projector and camera alike. Pictures: bytes, row by row from the top.
/// Threads  pure; any.
/// Source   Gray, US patent 2632058, 1953; Sansoni, Carocci, Rodella, Three-dimensional vision based on a combination of Gray-code and phase-shift light
///          projection, 1999; Xu, Aliaga, Robust pixel classification for 3D modeling with structured light, 2007 (bits that are not believed)
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen {

struct StripeSetup {
    int width = 0; ///< the projector's picture
    int height = 0;
    int period_px = 16; ///< of the cosine; even
    int steps = 8;      ///< of its shift; 3 at least
};

enum class Stripes { Bit, InverseBit, Cosine, White, Black };

/// One picture of the series.
struct Pattern {
    Stripes stripes = Stripes::White;
    bool rows = false; ///< it tells rows (v) and not columns (u)
    int which = 0;     ///< the bit, 0 the finest; or the step
    [[nodiscard]] bool operator==(const Pattern&) const = default;
};

/// In the order in which they are shown and captured.
[[nodiscard]] std::vector<Pattern> patterns_of(const StripeSetup& setup);
/// What a pattern shows at a place along its axis: column or row, 0 the first.
[[nodiscard]] std::uint8_t pattern_value(const StripeSetup& setup, const Pattern& pattern, int place);
/// The whole picture, `width` * `height` bytes.
[[nodiscard]] std::vector<std::uint8_t> pattern_picture(const StripeSetup& setup, const Pattern& pattern);

/// What is believed, in grey levels of 255 and in shares of white less black.
struct DecodeLimits {
    double least_contrast = 12.0; ///< of white and black: below, the projector does not light it
    double least_amplitude = 3.0; ///< of the cosine: below, the camera's noise turns it
    double least_wave =
        0.05; ///< the same as a share: below, light comes by way of other places, or is blurred away
    double least_bit =
        0.2; ///< share, of a bit and its inverse: below, it is not believed; one such bit an axis is a stripe's edge
};

/// Captures: one of each pattern, in their order, `width` * `height` bytes each.
struct Captures {
    int width = 0; ///< the camera's picture
    int height = 0;
    std::vector<std::span<const std::uint8_t>> pictures;
};

/// The projector's pixel at the centre of each of the camera's.
struct PixelMap {
    int width = 0;
    int height = 0;
    std::vector<glm::dvec2> pixels;
    std::vector<std::uint8_t> known;    ///< 1 where `pixels` is
    std::vector<std::uint8_t> contrast; ///< grey levels of white less black, where known
};
/// Pictures in another number or size than the setup's are the caller's error.
[[nodiscard]] PixelMap decode(const StripeSetup& setup, const Captures& captures,
                              const DecodeLimits& limits = {});

} // namespace frustumscreen
