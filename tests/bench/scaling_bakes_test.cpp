// Bakes against the number of triangles: the report that a bake leaves, and the limits that are told.
#include "app/bench/measures/scaling_bakes.h"

#include <gtest/gtest.h>

#include <array>

namespace frustumscreen::bench {
namespace {

TEST(ScalingBakes, ParsesTheReportOfABake) {
    const Result<ScalingBake> bake = scaling_bake_from(
        R"({"bytes": 12, "seconds": 3.5, "processor_seconds": 6.5, "memory_bytes": 7000, "default_level": 0,
            "levels": [{"mean_mm": 0.25}, {"mean_mm": 0.125}], "scan": {"triangles": 99}})");
    ASSERT_TRUE(bake) << bake.error().message;
    EXPECT_EQ(bake->triangles, 99U);
    EXPECT_EQ(bake->pack_bytes, 12U);
    EXPECT_EQ(bake->memory_bytes, 7000U);
    EXPECT_EQ(bake->processor_seconds, 6.5);
    EXPECT_EQ(bake->shown_mean_mm, 0.25);
    EXPECT_EQ(bake->min_mean_mm, 0.125);
    EXPECT_EQ(bake->levels, 2U);
}

TEST(ScalingBakes, RejectsMalformedReports) {
    for (const char* text : {"", "{}", "[1]", R"({"levels": [], "default_level": 0})"}) {
        EXPECT_FALSE(scaling_bake_from(text)) << text;
    }
}

TEST(ScalingBakes, ALimitIsMissedByASecondOrAByte) {
    ScalingBake bake{.triangles = 20'000'038,
                     .scan_bytes = 1,
                     .seconds = 180.0,
                     .processor_seconds = 300.0,
                     .memory_bytes = std::uint64_t{6} << 30U,
                     .pack_bytes = 1,
                     .shown_mean_mm = 0.02,
                     .min_mean_mm = 0.01};
    EXPECT_EQ(bakes_table(std::array{bake}).find("MISSED"), std::string::npos);
    bake.seconds = 181.0;
    EXPECT_NE(bakes_table(std::array{bake}).find("MISSED 20000038 triangles are baked in <= 180 s"),
              std::string::npos);
    bake.seconds = 1.0;
    ++bake.memory_bytes;
    EXPECT_NE(bakes_table(std::array{bake}).find("MISSED 20000038 triangles are baked in <= 6 GiB"),
              std::string::npos);
}

} // namespace
} // namespace frustumscreen::bench
