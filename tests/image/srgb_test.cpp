#include "app/image/image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

using namespace frustumscreen;
using namespace frustumscreen::image;

TEST(Srgb, round_trip_keeps_every_code) {
    for (int code = 0; code < 256; ++code) {
        EXPECT_EQ(srgb8_from_linear(linear_from_srgb(code / 255.0)), code);
        EXPECT_EQ(srgb8_from_linear(linear_from_srgb8()[static_cast<std::size_t>(code)]), code);
    }
}

TEST(Srgb, matches_the_standard_at_known_points) {
    EXPECT_NEAR(linear_from_srgb(0.5), 0.21404114, 1e-8);
    EXPECT_NEAR(srgb_from_linear(0.18), 0.46135612, 1e-8);
    EXPECT_NEAR(linear_from_srgb(0.04045), 0.04045 / 12.92, 1e-15);
}

TEST(Srgb, the_nearest_code_is_the_rounded_curve) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> light(0.0, 1.0);
    for (int k = 0; k < 100000; ++k) {
        const double linear = std::pow(light(random), 4.0);
        const double code = 255.0 * srgb_from_linear(linear);
        if (std::abs(code - std::floor(code) - 0.5) > 1e-4) { // the two branches of the standard meet to 1e-7
            ASSERT_EQ(srgb8_from_linear(linear), static_cast<int>(std::lround(code))) << linear;
        }
    }
}

TEST(Srgb, light_out_of_range_is_clamped) {
    EXPECT_EQ(srgb8_from_linear(-1.0), 0);
    EXPECT_EQ(srgb8_from_linear(7.0), 255);
    EXPECT_EQ(srgb8_from_linear(std::numeric_limits<double>::quiet_NaN()), 0);
    EXPECT_EQ(srgb8_from_linear(std::numeric_limits<double>::infinity()), 255);
}

TEST(Pfm, rows_go_bottom_to_top_after_the_header) {
    ImageFloat image(2, 3);
    for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 2; ++x) {
            image.at(x, y) = {static_cast<float>(x), static_cast<float>(y), 0.5F};
        }
    }
    const Bytes bytes = encode_pfm(image);
    const std::string header = "PF\n2 3\n-1.0\n";
    ASSERT_EQ(bytes.size(), header.size() + 72);
    EXPECT_EQ(as_text(bytes).substr(0, header.size()), header);
    float first[3];
    std::memcpy(first, bytes.data() + header.size(), sizeof first);
    EXPECT_EQ(first[0], 0.0F);
    EXPECT_EQ(first[1], 2.0F);
    EXPECT_EQ(first[2], 0.5F);
}
