#include "app/scene/pixel_density.h"

#include <gtest/gtest.h>

namespace frustumscreen::scene {
namespace {

// A surface of half the density has a quarter of the pixels of a frontal view: the bake's samples allow for
// that. Each further halving of the pixels is compensated by twice the samples.
TEST(SamplesAt, AreUnchangedDownToHalfTheDensity) {
    for (const double density : {2.0, 1.0, 0.7, 0.5}) {
        for (const int asked : {1, 2, 4, 8, 16}) {
            EXPECT_EQ(samples_at(density, asked), asked) << density;
        }
    }
}

TEST(SamplesAt, DoubleWithEachHalvingOfThePixels) {
    EXPECT_EQ(samples_at(0.49, 1), 2);
    EXPECT_EQ(samples_at(0.49, 2), 4);
    EXPECT_EQ(samples_at(0.36, 2), 4); // 0.5 / sqrt 2 = 0.354
    EXPECT_EQ(samples_at(0.35, 2), 8);
    EXPECT_EQ(samples_at(0.25, 1), 4); // a quarter of the pixels at half the density
    EXPECT_EQ(samples_at(0.25, 2), 8);
    EXPECT_EQ(samples_at(0.24, 1), 8);
    EXPECT_EQ(samples_at(0.25, 4), 16);
}

TEST(SamplesAt, AreSixteenAtMost) {
    EXPECT_EQ(samples_at(0.24, 4), 16);
    EXPECT_EQ(samples_at(1e-6, 1), 16);
    EXPECT_EQ(samples_at(0.49, 16), 16);
}

TEST(SamplesAt, AreUnchangedWithoutRequestOrDensity) {
    EXPECT_EQ(samples_at(0.1, 0), 0);
    EXPECT_EQ(samples_at(0.0, 2), 2);
}

TEST(PixelDensityOfFaces, IsAMeanByTheirAreas) {
    const geometry::Pinhole projector{640, 400, 1000.0, 1000.0, 320.0, 200.0};
    PixelDensity density;
    EXPECT_EQ(density.share(0.5, projector), 1.0); // no face
    density.add({0, 0, 30, 10}, 2000.0);           // as dense as a frontal view at 0.5 m
    EXPECT_DOUBLE_EQ(density.share(0.5, projector), 1.0);
    density.add({0, 0, 10, 10}, 400.0); // a fifth
    EXPECT_DOUBLE_EQ(density.share(0.5, projector), (3.0 * 1.0 + 0.2) / 4.0);
}

} // namespace
} // namespace frustumscreen::scene
