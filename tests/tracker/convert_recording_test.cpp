#include "firmware_host/tracker/convert_recording.h"
#include "tests/base/text_of.h"
#include "tests/base/told.h"
#include "tests/folders.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iterator>

namespace frustumscreen::tracker {
namespace {

ConvertedRecording converted(const std::string& text, const RecordingOptions& options = {}) {
    const auto result = convert_recording(text, "walk.txt", options);
    EXPECT_TRUE(result) << result.error().message;
    return result.value_or(ConvertedRecording());
}

TEST(ConvertRecording, ReadsCommasAndBlanksWithTheScalarLast) {
    for (const std::string text :
         {"# c\n100.5, 1, 2, 3, 0, 0, 0.6, 0.8\n", "t x y z qx qy qz qw\n100.5 1\t2  3 0 0 0.6 0.8\n"}) {
        const ConvertedRecording recording = converted(text);
        ASSERT_EQ(recording.samples.size(), 1U);
        const PoseSample& sample = recording.samples.front();
        EXPECT_EQ(to_microseconds(sample.time), 0);
        EXPECT_EQ(sample.position_m, glm::dvec3(1, 2, 3));
        EXPECT_NEAR(sample.rotation.w, 0.8, 1e-15);
        EXPECT_NEAR(sample.rotation.z, 0.6, 1e-15);
        EXPECT_TRUE(sample.ok);
    }
}

TEST(ConvertRecording, DropsRowsWithoutAscendingTimeAndFixesSigns) {
    const ConvertedRecording recording = converted("10.00 0 0 0 0 0 0 1\n"
                                                   "10.01 1 0 0 0 0 0 -1\n" // sign flipped
                                                   "10.01 2 0 0 0 0 0 -1\n" // time does not advance
                                                   "10.00 3 0 0 0 0 0 1\n"  // time goes back
                                                   "10.02 4 0 0 0 0 0.1 -0.99\n"
                                                   "10.03 5 0 0 0 0 -0.1 0.99\n", // sign flipped
                                                   {head_station, false, {}});
    EXPECT_EQ(recording.dropped_rows, 2);
    EXPECT_EQ(recording.sign_flips, 2);
    ASSERT_EQ(recording.samples.size(), 4U);
    EXPECT_EQ(to_microseconds(recording.samples[3].time), 30000);
    EXPECT_EQ(recording.samples[3].station, head_station);
    for (const PoseSample& sample : recording.samples) {
        EXPECT_GT(sample.rotation.w, 0.9);
    }
}

TEST(ConvertRecording, FlatKeepsTheRotationAboutZOfATiltedBody) {
    // A body tilted by 100 degrees about X that turns about the vertical and moves in a circle of 1 m.
    std::string text;
    const glm::dquat tilt = glm::angleAxis(glm::radians(100.0), glm::dvec3(1, 0, 0));
    for (int k = 0; k < 200; ++k) {
        const double angle = 0.05 * k;
        const glm::dquat q = glm::angleAxis(angle, glm::dvec3(0, 0, 1)) * tilt;
        text += std::to_string(0.01 * k) + " " + std::to_string(5 + std::cos(angle)) + " " +
                std::to_string(-3 + std::sin(angle)) + " 1.5 " + std::to_string(q.x) + " " +
                std::to_string(q.y) + " " + std::to_string(q.z) + " " + std::to_string(q.w) + "\n";
    }
    const ConvertedRecording recording = converted(text, {prop_station, true, {0.2, 0.1}});
    EXPECT_NEAR(recording.scale, 0.1, 1e-3);
    for (std::size_t k = 0; k < recording.samples.size(); ++k) {
        const double angle = 0.05 * static_cast<double>(k);
        const PoseSample& sample = recording.samples[k];
        EXPECT_NEAR(sample.position_m.x, 0.1 * std::cos(angle), 1e-3);
        EXPECT_NEAR(sample.position_m.y, 0.1 * std::sin(angle), 1e-3);
        EXPECT_EQ(sample.position_m.z, 0.0);
        const glm::dvec3 turned = sample.rotation * glm::dvec3(1, 0, 0);
        EXPECT_NEAR(turned.x, std::cos(angle), 1e-4);
        EXPECT_NEAR(turned.y, std::sin(angle), 1e-4);
        EXPECT_EQ(sample.rotation.x, 0.0);
    }
}

TEST(ConvertRecording, RefusalsNameTheLine) {
    const auto refusal = [](const std::string& text) {
        const auto result = convert_recording(text, "walk.txt", {});
        EXPECT_FALSE(result);
        return result ? std::string() : test::told(result.error());
    };
    EXPECT_NE(refusal("0 0 0 0 0 0 0 1\n0 0 0\n").find("walk.txt:2: the row has 3 fields"),
              std::string::npos);
    EXPECT_NE(refusal("0 0 0 x 0 0 0 1\n").find("walk.txt:1: z is \"x\""), std::string::npos);
    EXPECT_NE(refusal("0 0 0 nan 0 0 0 1\n").find("walk.txt:1: z is \"nan\""), std::string::npos);
    EXPECT_NE(refusal("1e300 0 0 0 0 0 0 1\n").find("walk.txt:1: t is \"1e300\""), std::string::npos);
    EXPECT_NE(refusal("0 0 0 0 0 0 0 0\n").find("walk.txt:1: the quaternion is zero"), std::string::npos);
    EXPECT_NE(refusal("# nothing\n").find("walk.txt: it holds no pose"), std::string::npos);
}

/// Numbers of rows as in INDEX.tsv.
struct Recording {
    const char* name;
    std::size_t rows;
    int dropped;
};

TEST(ConvertRecording, RejectsATimeSpanBeyondThePoseFileLimit) {
    const auto result = convert_recording("-3e9 0 0 0 0 0 0 1\n3e9 0 0 0 0 0 0 1\n", "walk.txt", {});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().message.rfind("walk.txt:2: t is ", 0), 0U) << result.error().message;
}

TEST(ConvertRecording, TheRecordingsInTheSharedFolderBecomePoses) {
    const std::filesystem::path folder = shared_dir() + "/data/tracker";
    if (!std::filesystem::exists(folder)) {
        GTEST_SKIP() << "the shared folder with the recordings is not there";
    }
    for (const Recording& expected : {Recording{"vicon_handheld_1.csv", 7093, 5},
                                      {"camera_target_handheld_1.csv", 1533, 0},
                                      {"tum_fr1_xyz_groundtruth.txt", 3000, 0},
                                      {"tum_fr1_xyz_rgbdslam.txt", 788, 0}}) {
        const ConvertedRecording recording =
            converted(text_of(folder / expected.name), {prop_station, true, {0.17, 0.13}});
        EXPECT_EQ(recording.samples.size() + static_cast<std::size_t>(recording.dropped_rows), expected.rows)
            << expected.name;
        EXPECT_EQ(recording.dropped_rows, expected.dropped) << expected.name;
        for (std::size_t k = 1; k < recording.samples.size(); ++k) {
            const PoseSample& sample = recording.samples[k];
            EXPECT_GT(sample.time, recording.samples[k - 1].time);
            EXPECT_GE(glm::dot(sample.rotation, recording.samples[k - 1].rotation), 0.0);
            EXPECT_LE(std::abs(sample.position_m.x), 0.17 + 1e-12);
            EXPECT_LE(std::abs(sample.position_m.y), 0.13 + 1e-12);
        }
    }
}

} // namespace
} // namespace frustumscreen::tracker
