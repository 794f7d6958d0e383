// Striped pictures and their decoding: exact without disturbance, within tenths of a pixel with a camera's.
#include "app/calibration/gray_code.h"
#include "tests/simulators/table/simulated_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace frustumscreen::calibration {
namespace {

/// Captures by a camera whose pixels coincide with the projector's.
Captures as_captures(const StripeSetup& setup, const std::vector<std::vector<std::uint8_t>>& pictures) {
    return {setup.width, setup.height, {pictures.begin(), pictures.end()}};
}

std::vector<std::vector<std::uint8_t>> shown(const StripeSetup& setup) {
    std::vector<std::vector<std::uint8_t>> pictures;
    for (const Pattern& pattern : patterns_of(setup)) {
        pictures.push_back(pattern_picture(setup, pattern));
    }
    return pictures;
}

/// Applies a function to every grey, for example to dim white so that it is not clipped.
template <typename Change>
std::vector<std::vector<std::uint8_t>> changed(std::vector<std::vector<std::uint8_t>> pictures,
                                               Change change) {
    for (std::vector<std::uint8_t>& picture : pictures) {
        for (std::uint8_t& grey : picture) {
            grey = static_cast<std::uint8_t>(std::lround(change(grey / 255.0)));
        }
    }
    return pictures;
}

/// The largest error of the known pixels, and their share.
std::pair<double, double> error_and_share(const StripeSetup& setup, const PixelMap& map) {
    double worst = 0.0;
    double known = 0.0;
    for (int y = 0; y < setup.height; ++y) {
        for (int x = 0; x < setup.width; ++x) {
            const auto k = static_cast<std::size_t>(y * map.width + x);
            if (map.known[k] != 0) {
                known += 1.0 / (setup.width * setup.height);
                worst = std::max(worst, glm::distance(map.pixels[k], glm::dvec2(x + 0.5, y + 0.5)));
            }
        }
    }
    return {worst, known};
}

TEST(GrayCode, NeighbouringStripesDifferInOneBit) {
    const StripeSetup setup{1920, 1200};
    for (int x = 0; x + 1 < setup.width; ++x) {
        int different = 0;
        for (const Pattern& pattern : patterns_of(setup)) {
            if (pattern.stripes == Stripes::Bit && !pattern.rows) {
                different += pattern_value(setup, pattern, x) != pattern_value(setup, pattern, x + 1) ? 1 : 0;
            }
        }
        EXPECT_EQ(different, (x + 1) % 8 == 0 ? 1 : 0) << x;
    }
}

TEST(GrayCode, EachStripeHasItsOwnCode) {
    const StripeSetup setup{1920, 1200};
    std::vector<std::uint32_t> codes;
    for (int x = 0; x < setup.width; x += 8) {
        std::uint32_t code = 0;
        for (const Pattern& pattern : patterns_of(setup)) {
            if (pattern.stripes == Stripes::Bit && !pattern.rows) {
                code = 2 * code + (pattern_value(setup, pattern, x) != 0 ? 1U : 0U);
            }
        }
        codes.push_back(code);
    }
    std::sort(codes.begin(), codes.end());
    EXPECT_EQ(std::adjacent_find(codes.begin(), codes.end()), codes.end());
}

TEST(GrayCode, InversePatternsComplementTheirBits) {
    const StripeSetup setup{640, 400};
    const std::vector<Pattern> patterns = patterns_of(setup);
    int bits = 0;
    for (std::size_t k = 0; k < patterns.size(); ++k) {
        bits += patterns[k].stripes == Stripes::Bit ? 1 : 0;
        for (int x = 0; patterns[k].stripes == Stripes::Bit && x < 400; ++x) {
            EXPECT_EQ(pattern_value(setup, patterns[k], x) + pattern_value(setup, patterns[k + 1], x), 255);
        }
    }
    EXPECT_GE(bits, 10); // 640 columns
}

TEST(GrayCode, DecodesTheShownPatterns) {
    for (const StripeSetup& setup :
         {StripeSetup{320, 200}, StripeSetup{333, 97, 10, 5}, StripeSetup{64, 48, 32, 3}}) {
        const auto dimmed = changed(shown(setup), [](double light) { return 200.0 * light + 20.0; });
        const auto [worst, known] = error_and_share(setup, decode(setup, as_captures(setup, dimmed)));
        EXPECT_LT(worst, 0.05) << setup.width; // greys are whole numbers
        EXPECT_EQ(std::lround(1e6 * known), 1000000) << setup.width;
    }
}

TEST(GrayCode, ToleratesGamma) {
    const StripeSetup setup{320, 200};
    for (const double gamma : {0.45, 2.2}) {
        const auto bent =
            changed(shown(setup), [&](double light) { return 200.0 * std::pow(light, gamma) + 20.0; });
        const auto [worst, known] = error_and_share(setup, decode(setup, as_captures(setup, bent)));
        EXPECT_LT(worst, 0.06) << gamma;
        EXPECT_GT(known, 0.999);
    }
}

TEST(GrayCode, UnlitAndClippedPixelsAreUnknown) {
    const StripeSetup setup{64, 48};
    const auto dark = changed(shown(setup), [](double light) { return 8.0 * light + 90.0; });
    EXPECT_EQ(error_and_share(setup, decode(setup, as_captures(setup, dark))).second, 0.0);
    const auto bright = changed(shown(setup), [](double light) { return std::min(255.0, 400.0 * light); });
    EXPECT_EQ(error_and_share(setup, decode(setup, as_captures(setup, bright))).second, 0.0);
}

TEST(GrayCode, NoiseLeavesPixelsUnknown) {
    const StripeSetup setup{64, 48};
    simulators::SeededNumbers numbers(1);
    const auto noise =
        changed(shown(setup), [&](double) { return std::clamp(128.0 + 3.0 * numbers.normal(), 0.0, 255.0); });
    EXPECT_LT(error_and_share(setup, decode(setup, as_captures(setup, noise))).second, 0.005);
}

} // namespace
} // namespace frustumscreen::calibration
