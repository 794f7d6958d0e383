#include "app/scene/exposure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace frustumscreen::scene {
namespace {

double linear(int code) {
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// Two adjacent squares; the left one, `share` of the area, has the texture's left half, the right one its
/// right half.
struct Pair {
    pack::PackLevel level;
    image::Image8 texture{2, 1};

    Pair(double share, int left, int right, int right_alpha = 255) {
        const auto at = [](double x) { return static_cast<std::uint16_t>(std::lround(65535.0 * x)); };
        for (const auto& [x0, x1, u] : {std::array{0.0, share, 0.25}, std::array{share, 1.0, 0.75}}) {
            const auto first = static_cast<std::uint32_t>(level.vertices.size());
            for (const auto& [x, y] :
                 {std::array{x0, 0.0}, std::array{x1, 0.0}, std::array{x1, 1.0}, std::array{x0, 1.0}}) {
                level.vertices.push_back({{at(x), at(y), 0}, 0, {at(u), at(0.5)}});
            }
            for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) {
                level.indices.push_back(first + k);
            }
        }
        texture.at(0, 0) = {left, left / 2, 0, 255};
        texture.at(1, 0) = {right, right / 2, 0, right_alpha};
    }
    [[nodiscard]] double exposure(int code) const {
        return exposure_of(level, {1.0, 1.0, 1.0}, texture, code);
    }
};

TEST(Exposure, BringsTheBrightestPlacesToTheCode) {
    EXPECT_NEAR(Pair(0.5, 100, 50).exposure(235), linear(235) / linear(100), 1e-6);
    EXPECT_NEAR(Pair(0.5, 250, 50).exposure(235), linear(235) / linear(250), 1e-6) << "down too";
}

TEST(Exposure, TwoPerCentOfTheSurfaceMayBeBrighter) {
    EXPECT_NEAR(Pair(0.985, 100, 250).exposure(235), linear(235) / linear(100), 1e-6);
    EXPECT_NEAR(Pair(0.975, 100, 250).exposure(235), linear(235) / linear(250), 1e-6);
}

TEST(Exposure, IgnoresCutOutTexels) {
    EXPECT_NEAR(Pair(0.5, 100, 250, 0).exposure(235), linear(235) / linear(100), 1e-6);
}

TEST(Exposure, IsOneWhenOffOrEmptyAndLimitedForBlack) {
    EXPECT_EQ(Pair(0.5, 100, 50).exposure(0), 1.0);
    EXPECT_EQ(exposure_of({}, {1.0, 1.0, 1.0}, image::Image8(1, 1), 235), 1.0);
    EXPECT_EQ(Pair(0.5, 0, 0).exposure(235), max_exposure) << "black stays black";
}

} // namespace
} // namespace frustumscreen::scene
