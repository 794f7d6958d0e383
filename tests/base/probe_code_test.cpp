// The code in a picture's corner, byte by byte; tests/render checks the renderer's output with the same
// reader.
#include "firmware_host/base/probe_code.h"

#include <gtest/gtest.h>

namespace frustumscreen {
namespace {

using Corner = std::array<std::byte, probe_bytes>;

Corner corner_of(const std::array<int, 8>& greys) {
    Corner corner{};
    for (std::size_t k = 0; k < greys.size(); ++k) {
        for (std::size_t channel = 0; channel < 4; ++channel) {
            corner[4 * k + channel] = static_cast<std::byte>(channel < 3 ? greys[k] : 255);
        }
    }
    return corner;
}

TEST(ProbeCode, LowestBitIsFirstAndOneIsTheBrighterGrey) {
    EXPECT_EQ(read_probe(corner_of({1, 1, 1, 1, 1, 1, 1, 1})), std::uint8_t{0});
    EXPECT_EQ(read_probe(corner_of({2, 1, 2, 1, 1, 1, 1, 1})), std::uint8_t{5});
    EXPECT_EQ(read_probe(corner_of({1, 1, 1, 1, 1, 1, 1, 2})), std::uint8_t{128});
    EXPECT_EQ(probe_grey(5, 0), 2);
    EXPECT_EQ(probe_grey(5, 1), 1);
    EXPECT_EQ(probe_grey(128, 7), 2);
}

TEST(ProbeCode, RoundTripOfEveryCodeWithAnyAlpha) {
    for (unsigned code = 0; code < 256; ++code) {
        std::array<int, 8> greys{};
        for (int k = 0; k < probe_pixels; ++k) {
            greys.at(static_cast<std::size_t>(k)) = probe_grey(static_cast<std::uint8_t>(code), k);
        }
        Corner corner = corner_of(greys);
        EXPECT_EQ(read_probe(corner), static_cast<std::uint8_t>(code));
        corner[3] = std::byte{0};
        EXPECT_EQ(read_probe(corner), static_cast<std::uint8_t>(code));
    }
}

TEST(ProbeCode, BlackBrightAndColouredPixelsHaveNoCode) {
    EXPECT_FALSE(read_probe(corner_of({0, 0, 0, 0, 0, 0, 0, 0})));
    EXPECT_FALSE(read_probe(corner_of({1, 1, 1, 1, 1, 1, 1, 3})));
    for (std::size_t channel = 0; channel < 3; ++channel) {
        Corner corner = corner_of({1, 1, 1, 1, 1, 1, 1, 1});
        corner[4 * 6 + channel] = std::byte{2};
        EXPECT_FALSE(read_probe(corner)) << channel;
    }
}

} // namespace
} // namespace frustumscreen
