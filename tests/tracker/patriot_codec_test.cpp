#include "firmware_host/tracker/patriot_codec.h"
#include "tests/tracker/parsed_stream.h"
#include "tests/tracker/wire_bytes.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace frustumscreen::tracker {
namespace {

using wire::Wire;

const Wire frame_by_hand = wire::from_hex("5041 01 43 20 00 2800"      // PA, sensor 1, C, good, 40 bytes
                                          "E8030000 3D000000 02000000" // 1000 ms, frame 61, distortion 2
                                          "0000C841 000048C2 0000C842" // 25, -50, 100 cm
                                          "0000003F 0000003F 000000BF 0000003F" // 0.5, 0.5, -0.5, 0.5
);

ParsedStream parse_all(std::span<const std::byte> stream) {
    return parsed_stream(stream, parse_patriot);
}

TEST(PatriotCodec, ReadsAHandwrittenFrameAndConvertsToMetres) {
    const ParsedStream parsed = parse_all(frame_by_hand);
    ASSERT_EQ(parsed.frames.size(), 1U);
    EXPECT_EQ(parsed.left, 0U);
    const DeviceFrame& frame = parsed.frames[0];
    EXPECT_EQ(frame.tick, 1000U);
    EXPECT_EQ(frame.counter, 61U);
    const SensorPose& pose = frame.sensors[0];
    EXPECT_EQ(pose.sensor, 1);
    EXPECT_NEAR(pose.position_m.x, 0.25, 1e-15);
    EXPECT_NEAR(pose.position_m.y, -0.5, 1e-15);
    EXPECT_NEAR(pose.position_m.z, 1.0, 1e-15);
    EXPECT_EQ(pose.rotation, glm::dquat(0.5, 0.5, -0.5, 0.5));
    EXPECT_EQ(pose.distortion, 2);
    EXPECT_TRUE(pose.usable);
}

TEST(PatriotCodec, ReadsLibertyFrames) {
    for (const char* tag : {"4C59", "4C55"}) {
        Wire frame = frame_by_hand;
        const Wire letters = wire::from_hex(tag);
        std::copy(letters.begin(), letters.end(), frame.begin());
        EXPECT_EQ(parse_all(frame).frames.size(), 1U);
    }
}

/// Bits of the header that the format fixes: all except sensor, command, error and the reserved byte.
TEST(PatriotCodec, RejectsAnyWrongBitInTagOrSizeAndReadsTheNextFrame) {
    const Wire next = wire::patriot_frame(1017, 62, {});
    for (const std::size_t byte : {0U, 1U, 6U, 7U}) {
        for (unsigned bit = 0; bit < 8; ++bit) {
            Wire stream = frame_by_hand;
            stream[byte] ^= static_cast<std::byte>(1U << bit);
            stream.insert(stream.end(), next.begin(), next.end());
            const ParsedStream parsed = parse_all(stream);
            EXPECT_GE(parsed.refusals, 1);
            ASSERT_EQ(parsed.frames.size(), 1U) << "byte " << byte << " bit " << bit;
            EXPECT_EQ(parsed.frames[0].counter, 62U);
        }
    }
}

/// There is no checksum: a wrong bit elsewhere is refused, or moves the pose no farther than the checks
/// allow.
TEST(PatriotCodec, AnyOtherWrongBitGivesAValidPoseOrNone) {
    for (std::size_t bit = 16; bit < frame_by_hand.size() * 8; ++bit) {
        Wire stream = frame_by_hand;
        stream[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
        for (const DeviceFrame& frame : parse_all(stream).frames) {
            const SensorPose& pose = frame.sensors[0];
            EXPECT_TRUE(!pose.usable || is_pose(pose.position_m, pose.rotation));
        }
    }
}

TEST(PatriotCodec, WaitsForTheRestOfATruncatedFrame) {
    for (std::size_t cut = 0; cut < frame_by_hand.size(); ++cut) {
        const ParsedStream parsed = parse_all(std::span(frame_by_hand).first(cut));
        EXPECT_TRUE(parsed.frames.empty());
        EXPECT_EQ(parsed.refusals, 0);
        EXPECT_EQ(parsed.left, cut);
    }
}

TEST(PatriotCodec, ResynchronizesAfterATruncatedFrame) {
    const Wire next = wire::patriot_frame(1017, 62, {});
    for (std::size_t cut = 1; cut < frame_by_hand.size(); ++cut) {
        Wire stream(frame_by_hand.begin(), frame_by_hand.begin() + static_cast<std::ptrdiff_t>(cut));
        for (int k = 0; k < 3; ++k) {
            stream.insert(stream.end(), next.begin(), next.end());
        }
        int good = 0;
        for (const DeviceFrame& frame : parse_all(stream).frames) {
            good += frame.counter == 62 && frame.sensors[0].usable ? 1 : 0;
        }
        EXPECT_GE(good, 2) << "cut " << cut;
    }
}

TEST(PatriotCodec, GarbageInFrontIsSkipped) {
    std::mt19937 engine(3);
    for (int length = 1; length < 300; ++length) {
        Wire stream;
        for (int k = 0; k < length; ++k) {
            stream.push_back(static_cast<std::byte>("PALYU\1\n\xFF"[engine() % 8]));
        }
        stream.insert(stream.end(), frame_by_hand.begin(), frame_by_hand.end());
        const ParsedStream parsed = parse_all(stream);
        ASSERT_EQ(parsed.frames.size(), 1U) << length;
        EXPECT_EQ(parsed.frames[0].counter, 61U);
    }
}

TEST(PatriotCodec, RejectsNanAndAZeroQuaternion) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t k = 0; k < 7; ++k) {
        wire::Pose pose;
        (k < 3 ? pose.position[k] : pose.quaternion[k - 3]) = nan;
        EXPECT_TRUE(parse_all(wire::patriot_frame(1, 1, pose)).frames.empty());
    }
    wire::Pose nothing;
    nothing.quaternion = {};
    EXPECT_TRUE(parse_all(wire::patriot_frame(1, 1, nothing)).frames.empty());
}

TEST(PatriotCodec, FrameWithAnErrorIsNotUsable) {
    const ParsedStream parsed = parse_all(wire::patriot_frame(1, 1, {}, 'e'));
    ASSERT_EQ(parsed.frames.size(), 1U);
    EXPECT_FALSE(parsed.frames[0].sensors[0].usable);
}

TEST(PatriotCodec, ParsesTheUnitsAnswer) {
    EXPECT_EQ(patriot_units_answer("01U 1\r\n"), 1);
    EXPECT_EQ(patriot_units_answer("00U 0\r\n"), 0);
    EXPECT_EQ(patriot_units_answer("01V PATRIOT U 0\r\n  U1\r\n"), 1);
    EXPECT_EQ(patriot_units_answer("01U 1"), std::nullopt); // incomplete line
    EXPECT_EQ(patriot_units_answer("01U 10\r\n"), std::nullopt);
    EXPECT_EQ(patriot_units_answer("01U\r\n"), std::nullopt);
    EXPECT_EQ(patriot_units_answer("01Ue 1\r\n"), std::nullopt); // an error letter
    EXPECT_EQ(patriot_units_answer("\r\n\r\n"), std::nullopt);
    EXPECT_EQ(patriot_units_answer(""), std::nullopt);
}

TEST(PatriotCodec, MutatedFramesGiveOnlyValidPoses) {
    Wire seed = frame_by_hand;
    const Wire more = wire::patriot_frame(1017, 62, {2});
    seed.insert(seed.end(), more.begin(), more.end());
    std::mt19937 engine(21);
    for (int mutant = 0; mutant < 100'000; ++mutant) {
        Wire bytes = seed;
        const std::size_t changes = 1 + engine() % 6;
        for (std::size_t k = 0; k < changes; ++k) {
            bytes[engine() % bytes.size()] = static_cast<std::byte>(engine());
        }
        bytes.resize(1 + engine() % bytes.size());
        const Wire exact(bytes);
        for (const DeviceFrame& frame : parse_all(exact).frames) {
            const SensorPose& pose = frame.sensors[0];
            EXPECT_TRUE(!pose.usable || is_pose(pose.position_m, pose.rotation));
            EXPECT_TRUE(pose.sensor >= 1 && pose.sensor <= 16);
        }
        const std::string_view text(reinterpret_cast<const char*>(exact.data()), exact.size());
        static_cast<void>(patriot_units_answer(text));
    }
}

} // namespace
} // namespace frustumscreen::tracker
