#include "app/bench/measures/shimmer.h"
#include "tests/bench/near_settings.h"
#include "tests/bench/ring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace frustumscreen::bench {
namespace {

/// A pixel that takes the codes of `sequence` one after another, in all three channels.
image::Image<float> flicker_of(const std::vector<int>& sequence) {
    Flicker flicker;
    for (const int code : sequence) {
        const auto value = static_cast<std::uint8_t>(code);
        flicker.add(image::Image8(2, 1, glm::u8vec4(value, value, value, 255)));
    }
    return flicker.per_pixel();
}

TEST(Flicker, IsZeroForLinearChange) {
    EXPECT_FLOAT_EQ(flicker_of({10, 13, 16, 19, 22}).at(0, 0), 0.0F);
    EXPECT_FLOAT_EQ(flicker_of({200, 150, 100, 50}).at(1, 0), 0.0F);
    EXPECT_FLOAT_EQ(flicker_of({0, 255}).at(0, 0), 0.0F); // two pictures are not enough
}

TEST(Flicker, IsTheRootMeanSquareOfSecondDifferences) {
    EXPECT_FLOAT_EQ(flicker_of({50, 60, 50, 60, 50, 60}).at(0, 0), 20.0F);
    EXPECT_FLOAT_EQ(flicker_of({0, 1, 4, 9, 16, 25, 36}).at(0, 0), 2.0F); // k^2
    // An edge that passes in one step: 0 0 0 255 255 255 has the differences 0, 255, -255, 0.
    EXPECT_FLOAT_EQ(flicker_of({0, 0, 0, 255, 255, 255}).at(0, 0), 255.0F / std::sqrt(2.0F));
    Flicker red_only;
    for (const int red : {30, 40, 30, 40}) {
        red_only.add(image::Image8(1, 1, glm::u8vec4(static_cast<std::uint8_t>(red), 7, 9, 255)));
    }
    EXPECT_FLOAT_EQ(red_only.per_pixel().at(0, 0), 20.0F / std::sqrt(3.0F));
}

TEST(Shimmer, IsComputedOnlyOverTheJudgedPixels) {
    image::Image<float> values(1000, 2);
    image::Image<std::uint8_t> judged(1000, 2);
    for (int x = 0; x < 1000; ++x) {
        judged.at(x, 0) = 1;
        values.at(x, 0) = x < 2 ? 50.0F : 4.0F;
        values.at(x, 1) = 200.0F;
    }
    EXPECT_NEAR(shimmer_of(values, judged).rms, std::sqrt((2 * 2500.0 + 998 * 16.0) / 1000.0), 1e-6);
    EXPECT_DOUBLE_EQ(shimmer_of(values, judged).q999, 50.0);
    values.at(0, 0) = 4.0F;
    EXPECT_DOUBLE_EQ(shimmer_of(values, judged).q999, 4.0);
}

TEST(Shimmer, CountsASpeckleAsExcessButNotAShiftedEdge) {
    image::Image<std::uint8_t> judged(20, 20, 1);
    image::Image<float> truth(20, 20, 3.0F);
    image::Image<float> drawn(20, 20, 3.0F);
    for (int y = 0; y < 20; ++y) {
        truth.at(5, y) = 100.0F;
        drawn.at(7, y) = 90.0F; // the same edge two pixels off
    }
    drawn.at(14, 9) = 40.0F;
    drawn.at(17, 9) = 10.0F; // within 8 codes
    const image::Image<std::uint8_t> found = excess(drawn, truth, judged);
    EXPECT_EQ(std::count(found.texels.begin(), found.texels.end(), 1), 1);
    EXPECT_EQ(found.at(14, 9), 1);
    judged.at(14, 9) = 0;
    const image::Image<std::uint8_t> none = excess(drawn, truth, judged);
    EXPECT_EQ(std::count(none.texels.begin(), none.texels.end(), 1), 0);
}

TEST(Shimmer, EachStepMovesThePropsMiddleByATenthOfAPixel) {
    const settings::Settings settings = near_settings();
    const geometry::PropShape prop = geometry::make_frustum({});
    for (const PushDirection direction : {PushDirection::Row, PushDirection::Column}) {
        const ShimmerSequence sequence(settings, prop, pose_at(0.04, -0.02, 0.7), direction, 20);
        ASSERT_EQ(sequence.poses().size(), 21U);
        for (std::size_t k = 0; k < 21; ++k) {
            // The lens is 0.9 m above the table and looks straight down, the middle of the prop is 0.06 m up:
            // one metre is 1400 / 0.84 pixels there, and the picture's rows run along X.
            const BenchPose& pose = sequence.poses()[k];
            const glm::dvec3 moved = pose.table_from_prop.translation - glm::dvec3(0.04, -0.02, 0.0);
            const double along = direction == PushDirection::Row ? moved.x : -moved.y;
            const double across = direction == PushDirection::Row ? moved.y : moved.x;
            EXPECT_NEAR(along * 1400.0 / 0.84, 0.1 * static_cast<double>(k), 1e-6);
            EXPECT_NEAR(across, 0.0, 1e-9);
            EXPECT_EQ(pose.eye_m, glm::dvec3(0.1, -0.5, 0.5));
        }
    }
}

class ShimmerOfTheTruth : public ::testing::Test {
protected:
    void SetUp() override {
        auto truth = Truth::build(ring(), glm::dmat4(1.0));
        ASSERT_TRUE(truth) << truth.error().message;
        truth_.emplace(std::move(*truth));
        sequence_.emplace(settings_, prop_, pose_at(0.01, 0.02, 0.4), PushDirection::Row, 8);
        sequence_->cast(*truth_, false);
    }
    [[nodiscard]] image::Image8 cast(const BenchPose& pose) const {
        return truth_->cast(prop_, view_of(settings_, pose), false).colour;
    }

    settings::Settings settings_ = near_settings();
    geometry::PropShape prop_ = geometry::make_frustum({});
    std::optional<Truth> truth_;
    std::optional<ShimmerSequence> sequence_;
};

TEST_F(ShimmerOfTheTruth, RatioToItselfIsOne) {
    ShimmerMaps maps;
    const SequenceShimmer found =
        sequence_->judge([this](const BenchPose& pose) { return cast(pose); }, maps);
    EXPECT_GT(found.judged_pixels, 1000);
    EXPECT_GT(found.one_ray.rms, 1.0);
    EXPECT_DOUBLE_EQ(found.rms_ratio(), 1.0);
    EXPECT_DOUBLE_EQ(found.q999_ratio(), 1.0);
    EXPECT_EQ(found.excess_pixels, 0);
}

TEST_F(ShimmerOfTheTruth, DetectsJitterOfHalfAPixel) {
    int frame = 0;
    ShimmerMaps maps;
    const SequenceShimmer found = sequence_->judge(
        [&](BenchPose pose) {
            pose.table_from_prop.translation.y += frame++ % 2 == 0 ? 0.0 : 0.5 * 0.84 / 1400.0;
            return cast(pose);
        },
        maps);
    EXPECT_GT(found.rms_ratio(), 1.5);
}

TEST_F(ShimmerOfTheTruth, CountsEachBlinkingPixelOnSmoothSurface) {
    const TruthPicture first = truth_->cast(prop_, view_of(settings_, sequence_->poses().front()), false);
    // Far inside the ring's body, where no neighbour shimmers: 11 x 11 pixels that all show it.
    const auto inside = [&](int x, int y) {
        for (int k = 0; k < 121; ++k) {
            if (first.hit.at(x - 5 + k % 11, y - 5 + k / 11) == 0) {
                return false;
            }
        }
        return true;
    };
    std::vector<glm::ivec2> speckles;
    for (int y = 20; y < 380 && speckles.size() < 3; y += 16) {
        for (int x = 20; x < 620 && speckles.size() < 3; ++x) {
            if (inside(x, y)) {
                speckles.emplace_back(x, y);
                break;
            }
        }
    }
    ASSERT_FALSE(speckles.empty());
    int frame = 0;
    ShimmerMaps maps;
    const SequenceShimmer found = sequence_->judge(
        [&](const BenchPose& pose) {
            image::Image8 picture = cast(pose);
            for (const glm::ivec2& at : speckles) {
                picture.at(at.x, at.y) = glm::u8vec4(glm::u8vec3(frame % 2 == 0 ? 0 : 255), 255);
            }
            ++frame;
            return picture;
        },
        maps);
    EXPECT_EQ(found.excess_pixels, static_cast<std::int64_t>(speckles.size()));
}

} // namespace
} // namespace frustumscreen::bench
