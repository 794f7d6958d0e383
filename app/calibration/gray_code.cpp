#include "app/calibration/gray_code.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace frustumscreen::calibration {

namespace {

constexpr double turn = 2.0 * std::numbers::pi;

/// Number of bits that encode the half periods along an axis.
int bit_count(const StripeSetup& setup, bool rows) {
    const int length = rows ? setup.height : setup.width;
    const int stripes = (2 * length + setup.period_px - 1) / setup.period_px;
    int bits = 1;
    while ((1 << bits) < stripes) {
        ++bits;
    }
    return bits;
}

std::uint32_t from_gray(std::uint32_t code) {
    for (std::uint32_t shift = 1; shift < 32; shift *= 2) {
        code ^= code >> shift;
    }
    return code;
}

/// Decodes one axis from its captures, at one camera pixel.
class Axis {
public:
    Axis(const StripeSetup& setup, const Captures& captures, std::size_t first, bool rows)
        : setup_(setup), captures_(captures), first_(first), bits_(bit_count(setup, rows)),
          length_(rows ? setup.height : setup.width) {
        for (int k = 0; k < setup.steps; ++k) {
            cosines_.push_back(std::cos(turn * k / setup.steps));
            sines_.push_back(std::sin(turn * k / setup.steps));
        }
    }
    [[nodiscard]] std::size_t end() const {
        return first_ + static_cast<std::size_t>(2 * bits_ + setup_.steps);
    }
    [[nodiscard]] std::optional<double> place(std::size_t pixel, double contrast,
                                              const DecodeLimits& limits) const {
        const std::optional<double> within =
            wave(pixel, std::fmax(limits.min_amplitude, limits.min_wave * contrast));
        const std::optional<std::uint32_t> stripe = half_period(pixel, limits.min_bit * contrast);
        if (!within || !stripe) {
            return std::nullopt;
        }
        const double period = setup_.period_px;
        const double middle = 0.5 * period * (*stripe + 0.5);
        const double place = *within + period * std::round((middle - *within) / period);
        return place >= 0.0 && place <= length_ ? std::optional(place) : std::nullopt;
    }

private:
    [[nodiscard]] double grey(std::size_t picture, std::size_t pixel) const {
        return captures_.pictures[first_ + picture][pixel];
    }
    /// The place within the period; nothing if the amplitude is too small or a capture is clipped.
    [[nodiscard]] std::optional<double> wave(std::size_t pixel, double least) const {
        double along = 0.0;
        double across = 0.0;
        for (std::size_t k = 0; k < cosines_.size(); ++k) {
            const double value = grey(static_cast<std::size_t>(2 * bits_) + k, pixel);
            if (value >= 255.0) {
                return std::nullopt;
            }
            along += value * cosines_[k];
            across += value * sines_[k];
        }
        const double amplitude = 2.0 / setup_.steps * std::hypot(along, across);
        return amplitude >= least ? std::optional(std::atan2(across, along) / turn * setup_.period_px)
                                  : std::nullopt;
    }
    [[nodiscard]] std::optional<std::uint32_t> half_period(std::size_t pixel, double least) const {
        std::uint32_t code = 0;
        int doubtful = 0;
        for (std::size_t bit = 0; bit < static_cast<std::size_t>(bits_); ++bit) { // highest bit first
            const double difference = grey(2 * bit, pixel) - grey(2 * bit + 1, pixel);
            code = 2 * code + (difference > 0.0 ? 1U : 0U);
            doubtful += std::abs(difference) < least ? 1 : 0;
        }
        return doubtful <= 1 ? std::optional(from_gray(code)) : std::nullopt;
    }

    const StripeSetup& setup_;
    const Captures& captures_;
    std::size_t first_;
    int bits_;
    double length_;
    std::vector<double> cosines_;
    std::vector<double> sines_;
};

} // namespace

std::vector<Pattern> patterns_of(const StripeSetup& setup) {
    std::vector<Pattern> patterns;
    for (const bool rows : {false, true}) {
        for (int bit = bit_count(setup, rows) - 1; bit >= 0; --bit) {
            patterns.push_back({Stripes::Bit, rows, bit});
            patterns.push_back({Stripes::InverseBit, rows, bit});
        }
        for (int step = 0; step < setup.steps; ++step) {
            patterns.push_back({Stripes::Cosine, rows, step});
        }
    }
    patterns.push_back({Stripes::White, false, 0});
    patterns.push_back({Stripes::Black, false, 0});
    return patterns;
}

std::uint8_t pattern_value(const StripeSetup& setup, const Pattern& pattern, int place) {
    switch (pattern.stripes) {
    case Stripes::Bit:
    case Stripes::InverseBit: {
        const int stripe = 2 * place / setup.period_px;
        const bool bit = (((stripe ^ (stripe >> 1)) >> pattern.which) & 1) != 0;
        return bit == (pattern.stripes == Stripes::Bit) ? 255 : 0;
    }
    case Stripes::Cosine: {
        const double phase =
            (place + 0.5) / setup.period_px - static_cast<double>(pattern.which) / setup.steps;
        return static_cast<std::uint8_t>(std::lround(127.5 + 127.5 * std::cos(turn * phase)));
    }
    case Stripes::White:
        return 255;
    case Stripes::Black:
        break;
    }
    return 0;
}

std::vector<std::uint8_t> pattern_picture(const StripeSetup& setup, const Pattern& pattern) {
    std::vector<std::uint8_t> picture;
    picture.reserve(static_cast<std::size_t>(setup.width) * static_cast<std::size_t>(setup.height));
    for (int y = 0; y < setup.height; ++y) {
        for (int x = 0; x < setup.width; ++x) {
            picture.push_back(pattern_value(setup, pattern, pattern.rows ? y : x));
        }
    }
    return picture;
}

PixelMap decode(const StripeSetup& setup, const Captures& captures, const DecodeLimits& limits) {
    const Axis columns(setup, captures, 0, false);
    const Axis rows(setup, captures, columns.end(), true);
    assert(captures.pictures.size() == rows.end() + 2);
    const std::span<const std::uint8_t> white = captures.pictures[rows.end()];
    const std::span<const std::uint8_t> black = captures.pictures[rows.end() + 1];
    PixelMap map;
    map.width = captures.width;
    map.height = captures.height;
    map.pixels.resize(white.size());
    map.known.resize(white.size());
    map.contrast.resize(white.size());
    for (std::size_t k = 0; k < white.size(); ++k) {
        const double contrast = static_cast<double>(white[k]) - static_cast<double>(black[k]);
        if (contrast < limits.min_contrast) {
            continue;
        }
        const auto u = columns.place(k, contrast, limits);
        const auto v = rows.place(k, contrast, limits);
        if (u && v) {
            map.pixels[k] = {*u, *v};
            map.known[k] = 1;
            map.contrast[k] = static_cast<std::uint8_t>(contrast);
        }
    }
    return map;
}

} // namespace frustumscreen::calibration
