#include "firmware_host/tracker/pose_file.h"
#include "tests/base/told.h"

#include <gtest/gtest.h>

#include <random>

namespace frustumscreen::tracker {
namespace {

const std::string header = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n";

std::string refusal(const std::string& text, PoseOrder order = PoseOrder::AsWritten) {
    const auto poses = parse_poses(text, "walk.csv", order);
    EXPECT_FALSE(poses) << "taken: " << text;
    if (poses) {
        return {};
    }
    EXPECT_EQ(poses.error().kind, ErrorKind::BadInput);
    EXPECT_EQ(poses.error().message.find_first_of("\n\r"), std::string::npos);
    return test::told(poses.error());
}

void expect_in(const std::string& message, const std::string& words) {
    EXPECT_NE(message.find(words), std::string::npos) << "'" << words << "' not in: " << message;
}

TEST(PoseFile, ReadsRowsPastCommentsBlanksAndCarriageReturns) {
    const auto poses =
        parse_poses("\xEF\xBB\xBF# a walk\n" + header +
                        "\n  # indented\n-5,1,0.1,-2e-2,0,1,0,0,0,1\r\n 10 , 2 , 0,0,0.5, 0,0,0,-2 , 1",
                    "walk.csv");
    ASSERT_TRUE(poses) << poses.error().message;
    ASSERT_EQ(poses->size(), 2U);
    EXPECT_EQ(to_microseconds((*poses)[0].time), -5);
    EXPECT_EQ((*poses)[0].station, prop_station);
    EXPECT_EQ((*poses)[0].position_m, glm::dvec3(0.1, -0.02, 0.0));
    EXPECT_TRUE((*poses)[0].ok);
    EXPECT_EQ((*poses)[1].station, head_station);
    EXPECT_EQ((*poses)[1].rotation, glm::dquat(0, 0, 0, -1));
}

TEST(PoseFile, NormalizesQuaternions) {
    const auto poses = parse_poses(header + "0,1,0,0,0,3,0,0,4,1\n", "walk.csv");
    ASSERT_TRUE(poses);
    EXPECT_NEAR(poses->front().rotation.w, 0.6, 1e-15);
    EXPECT_NEAR(poses->front().rotation.z, 0.8, 1e-15);
}

TEST(PoseFile, RoundTrip) {
    std::mt19937 engine(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<PoseSample> samples;
    for (int k = 0; k < 2000; ++k) {
        PoseSample sample;
        sample.time = from_microseconds(static_cast<std::int64_t>(uniform(engine) * 1e12));
        sample.station = 1 + k % 3;
        sample.position_m = {uniform(engine), uniform(engine) * 1e-9, uniform(engine) * 100};
        sample.rotation =
            glm::normalize(glm::dquat(uniform(engine), uniform(engine), uniform(engine), uniform(engine)));
        samples.push_back(sample);
    }
    const auto read = parse_poses(write_poses(samples), "walk.csv");
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->size(), samples.size());
    for (std::size_t k = 0; k < samples.size(); ++k) {
        EXPECT_EQ((*read)[k].time, samples[k].time);
        EXPECT_EQ((*read)[k].station, samples[k].station);
        EXPECT_EQ((*read)[k].position_m, samples[k].position_m);
        EXPECT_GT(glm::dot((*read)[k].rotation, samples[k].rotation), 1 - 1e-15);
    }
}

TEST(PoseFile, AnUnusablePoseMayHoldAnyNumbers) {
    const auto poses = parse_poses(header + "7,1,nan,inf,1e9,0,0,0,0,0\n", "walk.csv");
    ASSERT_TRUE(poses) << poses.error().message;
    EXPECT_FALSE(poses->front().ok);
    EXPECT_EQ(poses->front().position_m, glm::dvec3(0.0));
    EXPECT_EQ(poses->front().rotation, glm::dquat(1, 0, 0, 0));
}

TEST(PoseFile, AHeaderAloneHoldsNoPoses) {
    const auto poses = parse_poses(header, "walk.csv");
    ASSERT_TRUE(poses);
    EXPECT_TRUE(poses->empty());
}

TEST(PoseFile, RefusalsNameTheLineAndWhatIsAllowed) {
    expect_in(refusal(""), "walk.csv:0: the first line is not the header; allowed is t_us,station");
    expect_in(refusal("0,1,0,0,0,1,0,0,0,1\n"), "walk.csv:1: the first line is not the header");
    expect_in(refusal("t_us,station,px_m,py_m,pz_m,qx,qy,qz,qw,ok\n"),
              "walk.csv:1: the first line is not the header");
    expect_in(refusal(header + "\n0,1,0,0,0,1,0,0,0\n"), "walk.csv:3: the row has 9 fields; allowed are 10");
    expect_in(refusal(header + "0,1,0,0,0,1,0,0,0,1,9\n"), "walk.csv:2: the row has 11 fields");
    expect_in(refusal(header + "0.5,1,0,0,0,1,0,0,0,1\n"), "walk.csv:2: t_us is \"0.5\"; allowed are whole");
    expect_in(refusal(header + "99999999999999999999,1,0,0,0,1,0,0,0,1\n"), "[poses.time]");
    expect_in(refusal(header + "9223372036854775807,1,0,0,0,1,0,0,0,1\n"), "[poses.time]");
    expect_in(refusal(header + "0,4,0,0,0,1,0,0,0,1\n"), "station is \"4\"; allowed are 1 (prop), 2 (head)");
    expect_in(refusal(header + "0,1,0,0,0,1,0,0,0,2\n"), "ok is \"2\"; allowed are 0 and 1");
    expect_in(refusal(header + "0,1,0,abc,0,1,0,0,0,1\n"),
              "walk.csv:2: py_m is \"abc\"; allowed is a finite number");
    expect_in(refusal(header + "0,1,0,0,nan,1,0,0,0,1\n"), "pz_m is \"nan\"");
    expect_in(refusal(header + "0,1,0,0,0,1,inf,0,0,1\n"), "qx is \"inf\"");
    expect_in(refusal(header + "0,1,0,0,0,1,1e999,0,0,1\n"), "qx is \"1e999\"");
    expect_in(refusal(header + "0,1,2000,0,0,1,0,0,0,1\n"), "px_m is \"2000\"; allowed are -1000 to 1000");
    expect_in(refusal(header + "0,1,1 2,0,0,1,0,0,0,1\n"), "px_m is \"1 2\"");
    expect_in(refusal(header + "0,1,,0,0,1,0,0,0,1\n"), "px_m is \"\"");
    expect_in(refusal(header + "0,1,0,0,0,0,0,0,0,1\n"), "walk.csv:2: the quaternion is zero");
    expect_in(refusal(header + "0,1,\x01\xff,0,0,1,0,0,0,1\n"), "px_m is \"?\?\"");
}

TEST(PoseFile, RefusesAPropThatGoesBackInTimeWhereAsked) {
    const std::string rows = header + "5,1,0,0,0,1,0,0,0,1\n9,2,0,0,0,1,0,0,0,1\n5,2,0,0,0,1,0,0,0,1\n";
    EXPECT_TRUE(parse_poses(rows + "6,1,0,0,0,1,0,0,0,1\n", "walk.csv", PoseOrder::PropAscends));
    const std::string back = rows + "5,1,0,0,0,1,0,0,0,1\n";
    EXPECT_TRUE(parse_poses(back, "walk.csv"));
    expect_in(refusal(back, PoseOrder::PropAscends),
              "walk.csv:5: t_us is 5 after 5; allowed are ascending times");
}

TEST(PoseFile, MutatedFilesAreReadOrRefusedInOneLine) {
    std::mt19937 engine(5);
    const auto below = [&](std::size_t end) {
        return std::uniform_int_distribution<std::size_t>(0, end - 1)(engine);
    };
    const std::string sound =
        header + "0,1,0.1,0.2,0,1,0,0,0,1\n0,2,0,-0.5,0.5,1,0,0,0,1\n16667,1,0.1,0.2,0,1,0,0,0,1\n";
    int read = 0;
    for (int k = 0; k < 3000; ++k) {
        std::string text = sound;
        for (std::size_t change = 0; change < 1 + below(3); ++change) {
            const std::size_t at = below(text.size());
            switch (below(3)) {
            case 0:
                text[at] = static_cast<char>(below(256));
                break;
            case 1:
                text.erase(at, 1 + below(5));
                break;
            default:
                text.insert(at, std::string(1, "0123456789.,-e\n#n\0"[below(18)]));
            }
        }
        if (const auto poses = parse_poses(text, "walk.csv")) {
            ++read;
            for (const PoseSample& sample : *poses) {
                EXPECT_NEAR(glm::length(sample.rotation), 1.0, 1e-12);
                EXPECT_LE(glm::length(sample.position_m), 2000.0);
            }
        } else {
            EXPECT_EQ(poses.error().message.rfind("walk.csv:", 0), 0U);
            EXPECT_EQ(poses.error().message.find_first_of("\n\r"), std::string::npos);
        }
    }
    EXPECT_GT(read, 100);
}

} // namespace
} // namespace frustumscreen::tracker
