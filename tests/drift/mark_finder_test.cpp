// A mark is found to a fraction of a pixel, and nothing is found if something else changed.
#include "app/drift/mark_finder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace frustumscreen::drift {
namespace {

constexpr int width = 120, height = 90;

/// A grey picture with a Gaussian spot of light, and noise that differs in each frame.
class Pictures {
public:
    explicit Pictures(double noise = 0.0) : noise_(noise) {}
    std::vector<std::uint8_t> with(const glm::dvec2& at, double light, double base = 60.0) {
        std::vector<std::uint8_t> luma;
        for (int v = 0; v < height; ++v) {
            for (int u = 0; u < width; ++u) {
                const glm::dvec2 from = glm::dvec2(u + 0.5, v + 0.5) - at;
                const double value =
                    base + light * std::exp(-0.5 * glm::dot(from, from) / 16.0) + noise_ * noise();
                luma.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0))));
            }
        }
        return luma;
    }
    std::vector<std::uint8_t> dark(double base = 60.0) { return with({0.0, 0.0}, 0.0, base); }

private:
    double noise() {
        double sum = -6.0;
        for (int k = 0; k < 12; ++k) {
            state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
            sum += static_cast<double>(state_ >> 33U) / 2147483648.0;
        }
        return sum;
    }
    double noise_;
    std::uint64_t state_ = 7;
};

void show(MarkFinder& finder, MarkPhase phase, const std::vector<std::uint8_t>& luma) {
    finder.add(phase, luma, width, height);
}

std::optional<FoundMark> found(Pictures& pictures, const glm::dvec2& at, double light,
                               const std::optional<PixelWindow>& near = std::nullopt) {
    MarkFinder finder;
    finder.begin();
    for (int k = 0; k < 8; ++k) {
        show(finder, MarkPhase::Before, pictures.dark());
        show(finder, MarkPhase::Lit, pictures.with(at, light));
        show(finder, MarkPhase::After, pictures.dark());
    }
    return finder.find(near);
}

TEST(MarkFinder, FindsTheMiddleOfTheLight) {
    Pictures pictures(1.5);
    for (const glm::dvec2 at : {glm::dvec2(40.2, 30.7), glm::dvec2(91.5, 61.1), glm::dvec2(63.0, 44.9)}) {
        const std::optional<FoundMark> mark = found(pictures, at, 20.0);
        ASSERT_TRUE(mark);
        EXPECT_LT(glm::distance(mark->pixel, at), 0.15);
        EXPECT_NEAR(mark->radius_px, 4.0 * std::sqrt(2.0 * std::log(2.0)), 2.0);
    }
}

TEST(MarkFinder, FindsADimMarkWithinItsNoise) {
    Pictures pictures(1.5);
    double worst = 0.0;
    for (int k = 0; k < 10; ++k) {
        const glm::dvec2 at(30.0 + 5.3 * k, 30.0 + 3.1 * k);
        const std::optional<FoundMark> mark = found(pictures, at, 6.0);
        ASSERT_TRUE(mark) << k;
        worst = std::fmax(worst, glm::distance(mark->pixel, at));
    }
    EXPECT_LT(worst, 0.8);
}

TEST(MarkFinder, FindsNothingWithoutLight) {
    Pictures pictures(2.0);
    for (int k = 0; k < 10; ++k) {
        EXPECT_FALSE(found(pictures, {50.0, 50.0}, 0.0));
    }
}

TEST(MarkFinder, SearchesOnlyItsWindow) {
    Pictures pictures(1.0);
    const PixelWindow left{{-20, 5}, {50, 80}}; // extends beyond the picture's edge
    EXPECT_TRUE(found(pictures, {30.0, 40.0}, 30.0, left));
    EXPECT_FALSE(found(pictures, {90.0, 40.0}, 30.0, left));
    EXPECT_FALSE(found(pictures, {30.0, 40.0}, 30.0, PixelWindow{{70, 70}, {72, 72}}));
    EXPECT_FALSE(found(pictures, {1.0, 40.0}, 30.0)) << "half of it is outside";
}

TEST(MarkFinder, IgnoresAnObjectThatAppears) {
    Pictures pictures(1.0);
    MarkFinder finder;
    finder.begin();
    for (int k = 0; k < 8; ++k) { // the object is there from the mark on
        show(finder, MarkPhase::Before, pictures.dark());
        show(finder, MarkPhase::Lit, pictures.with({60.0, 45.0}, 40.0));
        show(finder, MarkPhase::After, pictures.with({60.0, 45.0}, 40.0));
    }
    EXPECT_FALSE(finder.find(std::nullopt));
}

TEST(MarkFinder, FindsTheMarkWhileRoomLightGrows) {
    Pictures pictures(1.0);
    MarkFinder finder;
    finder.begin();
    for (int k = 0; k < 8; ++k) {
        show(finder, MarkPhase::Before, pictures.dark(60.0));
        show(finder, MarkPhase::Lit, pictures.with({60.0, 45.0}, 20.0, 61.0));
        show(finder, MarkPhase::After, pictures.dark(62.0));
    }
    const std::optional<FoundMark> mark = finder.find(std::nullopt);
    ASSERT_TRUE(mark);
    EXPECT_LT(glm::distance(mark->pixel, glm::dvec2(60.0, 45.0)), 0.2);
}

TEST(MarkFinder, UsesTheDarkAfterAMarkForTheNextOne) {
    Pictures pictures;
    MarkFinder finder;
    finder.begin();
    for (int k = 0; k < 3; ++k) {
        show(finder, MarkPhase::Before, pictures.dark(20.0));
        show(finder, MarkPhase::Lit, pictures.with({60.0, 45.0}, 40.0));
        show(finder, MarkPhase::After, pictures.dark());
    }
    finder.begin_after_mark();
    EXPECT_FALSE(finder.find(std::nullopt)) << "it has no light yet";
    for (int k = 0; k < 3; ++k) {
        show(finder, MarkPhase::Lit, pictures.with({30.0, 35.0}, 40.0));
        show(finder, MarkPhase::After, pictures.dark());
    }
    const std::optional<FoundMark> mark = finder.find(std::nullopt);
    ASSERT_TRUE(mark);
    EXPECT_LT(glm::distance(mark->pixel, glm::dvec2(30.0, 35.0)), 0.1);
    std::vector<std::uint8_t> dark;
    finder.dark_picture(dark);
    EXPECT_EQ(dark, pictures.dark());
}

TEST(MarkFinder, IgnoresTruncatedFrames) {
    MarkFinder finder;
    finder.begin();
    const std::vector<std::uint8_t> none;
    finder.add(MarkPhase::Lit, none, width, height);
    finder.add(MarkPhase::Lit, none, 0, 0);
    EXPECT_FALSE(finder.find(std::nullopt));
    std::vector<std::uint8_t> dark;
    finder.dark_picture(dark);
    EXPECT_TRUE(dark.empty());
}

} // namespace
} // namespace frustumscreen::drift
