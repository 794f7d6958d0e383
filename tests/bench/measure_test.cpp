#include "app/bench/measures/measure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace frustumscreen::bench {
namespace {

constexpr float nan_f = std::numeric_limits<float>::quiet_NaN();

/// A truth of 6 x 6 pixels with artifact where `rows` has '#'; its points are (x, y, 0) mm.
TruthPicture truth_of(const std::array<std::string_view, 6>& rows) {
    TruthPicture truth{{6, 6, 1}, {6, 6}, {6, 6, glm::vec3(nan_f)}, {6, 6, glm::u8vec4(0, 0, 0, 255)}, {}};
    for (int y = 0; y < 6; ++y) {
        for (int x = 0; x < 6; ++x) {
            if (rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] == '#') {
                truth.hit.at(x, y) = 1;
                truth.point_m.at(x, y) = glm::vec3(x, y, 0) * 0.001F;
                truth.colour.at(x, y) = {100, 100, 100, 255};
            }
        }
    }
    return truth;
}

constexpr std::array<std::string_view, 6> square = {"......", ".####.", ".####.",
                                                    ".####.", ".####.", "......"};

TEST(Measure, TheTruthItselfHasNoError) {
    const TruthPicture truth = truth_of(square);
    const PictureError error = measure(truth, {truth.colour, truth.point_m});
    EXPECT_EQ(error.truth_pixels, 16);
    EXPECT_EQ(error.outline_pixels, 12); // the 4 x 4 square without its inner 2 x 2
    EXPECT_EQ(error.mismatched_pixels, 0);
    EXPECT_EQ(error.geometric_mean_mm, 0.0);
    EXPECT_EQ(error.one_ray.rmse, 0.0);
}

TEST(Measure, AMissingAndAnExtraPixelAreSilhouetteErrors) {
    const TruthPicture truth = truth_of(square);
    Drawn drawn{truth.colour, truth.point_m};
    drawn.point_m.at(1, 1) = glm::vec3(nan_f);
    drawn.point_m.at(5, 5) = glm::vec3(0.0F);
    const PictureError error = measure(truth, drawn);
    EXPECT_EQ(error.mismatched_pixels, 2);
    EXPECT_DOUBLE_EQ(error.silhouette_percent, 100.0 * 2.0 / 16.0);
    EXPECT_DOUBLE_EQ(error.outline_shift_px, 2.0 / 12.0);
}

TEST(Measure, DistancesAreAveragedInMillimetresOverPixelsHitInBoth) {
    const TruthPicture truth = truth_of(square);
    Drawn drawn{truth.colour, truth.point_m};
    drawn.point_m.at(1, 1) += glm::vec3(0.0F, 0.003F, 0.004F); // 5 mm off in one of 15
    drawn.point_m.at(4, 4) = glm::vec3(nan_f);
    const PictureError error = measure(truth, drawn);
    EXPECT_NEAR(error.geometric_mean_mm, 5.0 / 15.0, 1e-6);
    EXPECT_NEAR(error.geometric_p95_mm, 5.0, 1e-5); // the 15th of 15: ceil(.95 * 15) = 15
}

TEST(Measure, ColourErrorsCountChannelsAndPixels) {
    TruthPicture truth = truth_of({"##....", "##....", "......", "......", "......", "......"});
    truth.colour16 = truth.colour;
    truth.colour16.at(0, 0).r = 110;
    Drawn drawn{truth.colour, truth.point_m};
    drawn.colour.at(0, 0).r = 110;                // 10 codes in one of 12 channels
    drawn.colour.at(1, 1).b = 80;                 // 20 codes: one bad pixel of four
    drawn.colour.at(3, 3) = {255, 255, 255, 255}; // no hit there: not counted
    const PictureError error = measure(truth, drawn);
    EXPECT_NEAR(error.one_ray.rmse, std::sqrt((100.0 + 400.0) / 12.0), 1e-12);
    EXPECT_DOUBLE_EQ(error.one_ray.bad_percent, 25.0);
    EXPECT_NEAR(error.sixteen_rays.rmse, std::sqrt(400.0 / 12.0), 1e-12);
}

TEST(Measure, BadPixelsDifferByMoreThanSixteenCodes) {
    const TruthPicture truth = truth_of({"#.....", "......", "......", "......", "......", "......"});
    Drawn drawn{truth.colour, truth.point_m};
    drawn.colour.at(0, 0).g = 116;
    EXPECT_EQ(measure(truth, drawn).one_ray.bad_percent, 0.0);
    drawn.colour.at(0, 0).g = 117;
    EXPECT_EQ(measure(truth, drawn).one_ray.bad_percent, 100.0);
}

TEST(Measure, PixelsAtThePicturesEdgeAreOutline) {
    const PictureError error = measure(truth_of({"######", "######", "######", "######", "######", "######"}),
                                       {image::Image8(6, 6), {6, 6}});
    EXPECT_EQ(error.outline_pixels, 20);
}

TEST(Measure, MeasuresCoverageAndColourOfTheShownPicture) {
    TruthPicture truth = truth_of(square);
    truth.shown16 = truth.colour;
    truth.met_by_16 = image::Image<std::uint8_t>(6, 6);
    ShownImages shown{truth.colour, {6, 6, glm::u8vec4(0, 0, 0, 255)}, 2};
    image::Image<float> of_samples(6, 6);
    for (int y = 1; y < 5; ++y) {
        for (int x = 1; x < 5; ++x) {
            truth.met_by_16.at(x, y) = 16;
            shown.white.at(x, y) = glm::u8vec4(255);
            of_samples.at(x, y) = 1.0F;
        }
    }
    truth.met_by_16.at(5, 1) = 4;                                          // a missing quarter,
    shown.white.at(0, 0) = {image::srgb8_from_linear(0.5), 188, 188, 255}; // half a pixel too much
    of_samples.at(5, 1) = 0.5F;             // exact rays would show a quarter too much
    shown.colour.at(2, 2).g = 112;          // 12 codes in one of 45 channels,
    shown.colour.at(1, 1) = {0, 0, 0, 255}; // and pixels not hit in both are not counted
    image::ImageFloat points = truth.point_m;
    points.at(1, 1) = glm::vec3(nan_f);
    const ShownError error = measure_shown(truth, shown, of_samples, points);
    EXPECT_NEAR(error.cover_px, (0.25 + 0.5) / 12.0, 1e-3);
    EXPECT_NEAR(error.cover_bias_px, (0.5 - 0.25) / 12.0, 1e-3);
    EXPECT_NEAR(error.cover_of_samples_px, 0.25 / 12.0, 1e-9);
    EXPECT_NEAR(error.colour.rmse, std::sqrt(144.0 / 45.0), 1e-12);
}

TEST(Measure, ASummaryHasTheMeanAndEachFiguresWorst) {
    PictureError a;
    a.silhouette_percent = 1.0;
    a.geometric_mean_mm = 0.4;
    a.truth_pixels = 100;
    PictureError b;
    b.silhouette_percent = 3.0;
    b.geometric_mean_mm = 0.2;
    b.truth_pixels = 300;
    a.shown = ShownError{};
    a.shown->cover_px = 0.1;
    b.shown = ShownError{};
    b.shown->cover_px = 0.3;
    b.shown->colour.rmse = 5.0;
    const std::array errors = {a, b};
    const ErrorSummary summary = summarise(errors);
    EXPECT_DOUBLE_EQ(summary.mean.silhouette_percent, 2.0);
    EXPECT_DOUBLE_EQ(summary.worst.silhouette_percent, 3.0);
    EXPECT_DOUBLE_EQ(summary.worst.geometric_mean_mm, 0.4);
    EXPECT_EQ(summary.mean.truth_pixels, 200);
    EXPECT_EQ(summary.worst_pose, 1);
    EXPECT_DOUBLE_EQ(summary.mean.shown->cover_px, 0.2);
    EXPECT_DOUBLE_EQ(summary.worst.shown->cover_px, 0.3);
    EXPECT_DOUBLE_EQ(summary.mean.shown->colour.rmse, 2.5);
    EXPECT_FALSE(summarise(std::array{PictureError{}}).mean.shown.has_value());
}

} // namespace
} // namespace frustumscreen::bench
