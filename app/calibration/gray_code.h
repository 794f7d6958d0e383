/// Finds the projector pixel that lights each camera pixel: generates striped patterns to show and decodes
/// their captures.
///
/// For columns, then for rows: each bit of a Gray code that counts half periods of a cosine, and its inverse;
/// then the cosine, shifted step by step. Last come a white picture and a black one. The cosine's phase gives
/// the place within its period to a fraction of a pixel; the Gray code gives the period. The code's stripes
/// are half a period wide, so that a code misread by one at a stripe's edge does no harm.
/// Gamma    n steps cancel the harmonics 2 to n - 2 that the projector's and the camera's response add to the
///          cosine.
/// Units    pixels of projector and camera, the centre of the top left one is (0.5, 0.5). Pictures: bytes,
///          row by row from the top.
/// Threads  pure; any.
/// Source   Gray, US patent 2632058, 1953; Sansoni, Carocci, Rodella, Three-dimensional vision based on a
///          combination of Gray-code and phase-shift light projection, 1999; Xu, Aliaga, Robust pixel
///          classification for 3D modeling with structured light, 2007 (uncertain bits)
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::calibration {

struct StripeSetup {
    int width = 0; ///< the projector's picture
    int height = 0;
    int period_px = 16; ///< of the cosine; even
    int steps = 8;      ///< phase shifts; at least 3
};

enum class Stripes { Bit, InverseBit, Cosine, White, Black };

/// One picture of the series.
struct Pattern {
    Stripes stripes = Stripes::White;
    bool rows = false; ///< encodes rows (v), not columns (u)
    int which = 0;     ///< the bit, 0 the finest; or the step
    [[nodiscard]] bool operator==(const Pattern&) const = default;
};

/// In the order in which they are shown and captured.
[[nodiscard]] std::vector<Pattern> patterns_of(const StripeSetup& setup);
/// A pattern's grey level at a place along its axis: a column or row, 0 the first.
[[nodiscard]] std::uint8_t pattern_value(const StripeSetup& setup, const Pattern& pattern, int place);
/// The whole picture, `width` * `height` bytes.
[[nodiscard]] std::vector<std::uint8_t> pattern_picture(const StripeSetup& setup, const Pattern& pattern);

/// Limits of the decoder, in grey levels of 255 and in shares of white less black.
struct DecodeLimits {
    double min_contrast = 12.0; ///< of white less black: below, the projector does not light the pixel
    double min_amplitude = 3.0; ///< of the cosine: below, the camera's noise dominates the phase
    double min_wave = 0.05;     ///< the same as a share: below, the light is indirect or blurred
    double min_bit =
        0.2; ///< share, of a bit and its inverse: below, the bit is uncertain; one such bit per axis is a stripe's edge
};

/// One capture of each pattern, in the patterns' order, `width` * `height` bytes each.
struct Captures {
    int width = 0; ///< the camera's picture
    int height = 0;
    std::vector<std::span<const std::uint8_t>> pictures;
};

/// The projector pixel at the centre of each camera pixel.
struct PixelMap {
    int width = 0;
    int height = 0;
    std::vector<glm::dvec2> pixels;
    std::vector<std::uint8_t> known;    ///< 1 where `pixels` is
    std::vector<std::uint8_t> contrast; ///< grey levels of white less black, where known
};
/// The number and size of the captures must match the setup.
[[nodiscard]] PixelMap decode(const StripeSetup& setup, const Captures& captures,
                              const DecodeLimits& limits = {});

} // namespace frustumscreen::calibration
