// Pixels shared by two faces: their positions, computed by hand; their changes, in hand-made and in drawn
// pictures.

#include "app/bench/measures/edge_sparkle.h"
#include "assets_baked/bake/bake.h"
#include "tests/bench/near_settings.h"
#include "tests/bench/ring.h"

#include <gtest/gtest.h>

#include <cmath>

namespace frustumscreen::bench {
namespace {

TEST(ChangeHistogram, MatchesTheStatisticsOfTheListOfChanges) {
    ChangeHistogram histogram;
    EXPECT_EQ(histogram.changes(), 0);
    EXPECT_EQ(histogram.rms(), 0.0);
    EXPECT_EQ(histogram.q999(), 0);
    EXPECT_EQ(histogram.largest(), 0);
    EXPECT_EQ(histogram.percent_over(25), 0.0);
    for (int k = 0; k < 997; ++k) {
        histogram.add(3);
    }
    ChangeHistogram more;
    more.add(26);
    more.add(25);
    more.add(255);
    histogram.add(more);
    EXPECT_EQ(histogram.changes(), 1000);
    EXPECT_NEAR(histogram.rms(), std::sqrt((997 * 9.0 + 26.0 * 26.0 + 25.0 * 25.0 + 255.0 * 255.0) / 1000.0),
                1e-12);
    EXPECT_EQ(histogram.q999(), 26) << "999 of 1000 are 26 or less";
    EXPECT_EQ(histogram.largest(), 255);
    EXPECT_NEAR(histogram.percent_over(25), 0.2, 1e-12);
}

TEST(EdgeZones, LieAtTheEdgesOfFacesThatEyeAndLensSee) {
    const settings::Settings settings = near_settings();
    // The top is 0.09 m wide, 0.78 m below the lens, and a metre at 1 m spans 1400 pixels: its front edge is
    // in row 200 + 1400 * 0.045 / 0.78 = 280.77, and its columns extend from 239.2 to 400.8.
    const image::Image<EdgeZone> zones =
        edge_zones(settings, settings::make_prop(settings.prop), pose_at(0.0, 0.0, 0.0));
    EXPECT_EQ(zones.at(320, 280), EdgeZone::Shared);
    EXPECT_EQ(zones.at(320, 279), EdgeZone::Near); // 1.27 pixels away
    EXPECT_EQ(zones.at(320, 281), EdgeZone::Near);
    EXPECT_EQ(zones.at(320, 278), EdgeZone::Beside); // 2.27
    EXPECT_EQ(zones.at(320, 285), EdgeZone::Beside); // 4.73
    EXPECT_EQ(zones.at(320, 286), EdgeZone::Away);
    EXPECT_EQ(zones.at(320, 119), EdgeZone::Away) << "the eye does not see the face behind the top";
    EXPECT_EQ(zones.at(239, 240), EdgeZone::Away) << "nor the one at its left";
    EXPECT_EQ(zones.at(400, 240), EdgeZone::Shared) << "but the one at its right";
    EXPECT_EQ(zones.at(398, 278), EdgeZone::Beside) << "of both edges";
    EXPECT_EQ(zones.at(398, 279), EdgeZone::Near) << "of one, beside the other";
}

TEST(EdgeSparkle, CountsChangesOnEdgesAndBesideThem) {
    const glm::u8vec4 grey(50, 50, 50, 255);
    std::array<image::Image8, 2> sharp{image::Image8(9, 5, grey), image::Image8(9, 5, grey)};
    std::array<image::Image8, 2> feathered = sharp;
    std::array<image::Image<EdgeZone>, 2> zones{image::Image<EdgeZone>(9, 5), image::Image<EdgeZone>(9, 5)};
    zones[0].at(2, 2) = EdgeZone::Shared; // only before the step
    zones[0].at(4, 2) = zones[1].at(4, 2) = EdgeZone::Beside;
    zones[0].at(5, 2) = EdgeZone::Beside; // away after it: not judged
    zones[1].at(7, 2) = EdgeZone::Shared;
    sharp[1].at(2, 2) = {50, 90, 41, 255};
    feathered[1].at(2, 2) = {50, 55, 60, 255};
    sharp[1].at(4, 2) = feathered[1].at(4, 2) = {53, 50, 50, 255};
    sharp[1].at(5, 2) = {99, 99, 99, 255};
    sharp[1].at(8, 3) = {0, 0, 0, 255}; // next to (7, 2): the artifact ends there
    EdgeSparkle sparkle;
    add_step(sharp, feathered, zones, sparkle);
    EXPECT_EQ(sparkle.sharp.changes(), 1);
    EXPECT_EQ(sparkle.sharp.largest(), 40);
    EXPECT_EQ(sparkle.feathered.changes(), 1);
    EXPECT_EQ(sparkle.feathered.largest(), 10);
    EXPECT_EQ(sparkle.beside_sharp.changes(), 1);
    EXPECT_EQ(sparkle.beside_feathered.largest(), 3);
}

TEST(EdgeSparkle, FeatheringReducesChangesOnlyAtEdges) {
    const std::shared_ptr<bake::SourceMesh> white = ring();
    white->textures[0].image = std::make_shared<image::Image8>(8, 8, glm::u8vec4(255));
    bake::BakeOptions options;
    options.size = 64;
    options.relief = false;
    options.unlit = true;
    options.measuring = 0.05;
    const Result<pack::Pack> pack = bake::bake(*white, options);
    ASSERT_TRUE(pack) << pack.error().message;
    const Result<std::vector<SparkleRow>> rows =
        edge_sparkle({"near", near_settings()}, *pack, {pose_at(0.0, -0.02, 0.3)}, 12, {}, [](double) {});
    ASSERT_TRUE(rows) << rows.error().message;
    ASSERT_EQ(rows->size(), 2U);
    EXPECT_TRUE((*rows)[0].along_x);
    EXPECT_FALSE((*rows)[1].along_x);
    for (const SparkleRow& row : *rows) {
        EXPECT_GT(row.sparkle.sharp.changes(), 100);
        EXPECT_EQ(row.sparkle.sharp.changes(), row.sparkle.feathered.changes());
        EXPECT_GT(row.sparkle.sharp.largest(), 25) << "the gains of the faces differ, or nothing is proved";
        EXPECT_LT(row.sparkle.feathered.rms(), 0.7 * row.sparkle.sharp.rms());
        EXPECT_EQ(row.sparkle.beside_sharp.rms(), row.sparkle.beside_feathered.rms());
    }
}

} // namespace
} // namespace frustumscreen::bench
