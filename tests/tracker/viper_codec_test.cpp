#include "firmware_host/tracker/viper_codec.h"
#include "tests/tracker/parsed_stream.h"
#include "tests/tracker/wire_bytes.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace frustumscreen::tracker {
namespace {

using wire::Wire;

/// Written by hand from the format's description; the last four bytes are the CRC.
const Wire frame_by_hand = wire::from_hex("56505250 34000000" // VPRP, 52 bytes follow
                                          "40E20100 04030201" // serial 123456, frame 0x01020304
                                          "00000000 01000000" // info, one sensor
                                          "004B0100"          // sensor 0, metres, quaternion, distortion 5
                                          "0000803E 000000BF 0000803F"          // 0.25, -0.5, 1
                                          "0000003F 0000003F 000000BF 0000003F" // 0.5, 0.5, -0.5, 0.5
                                          "3DA20000");

ParsedStream parse_all(std::span<const std::byte> stream) {
    return parsed_stream(stream, parse_viper);
}

TEST(ViperCodec, ChecksumIsTheStandardCrc16Arc) {
    constexpr std::string_view text = "123456789";
    EXPECT_EQ(crc16_arc(std::as_bytes(std::span(text.data(), text.size()))), 0xBB3D);
    EXPECT_EQ(crc16_arc({}), 0);
}

TEST(ViperCodec, AFrameWrittenOutByHandIsRead) {
    const ParsedStream parsed = parse_all(frame_by_hand);
    ASSERT_EQ(parsed.frames.size(), 1U);
    EXPECT_EQ(parsed.left, 0U);
    const DeviceFrame& frame = parsed.frames[0];
    EXPECT_EQ(frame.counter, 0x01020304U);
    ASSERT_EQ(frame.count, 1U);
    EXPECT_TRUE(frame.units_as_set);
    const SensorPose& pose = frame.sensors[0];
    EXPECT_EQ(pose.sensor, 1);
    EXPECT_EQ(pose.position_m, glm::dvec3(0.25, -0.5, 1.0));
    EXPECT_EQ(pose.rotation, glm::dquat(0.5, 0.5, -0.5, 0.5));
    EXPECT_EQ(pose.distortion, 5);
    EXPECT_TRUE(pose.usable);
}

TEST(ViperCodec, CommandsMatchTheSpecifiedBytes) {
    const ViperCommandBytes stop(ViperCommand::Continuous, ViperAction::Reset);
    const Wire stop_by_hand =
        wire::from_hex("56505243 18000000 FFFFFFFF 13000000 02000000 00000000 00000000 CFCA0000");
    EXPECT_EQ(Wire(stop.bytes().begin(), stop.bytes().end()), stop_by_hand);
    const std::array<std::uint32_t, 2> units{viper_metres, viper_quaternion};
    const ViperCommandBytes set(ViperCommand::Units, ViperAction::Set, std::as_bytes(std::span(units)));
    const Wire set_by_hand = wire::from_hex("56505243 20000000 FFFFFFFF 07000000 00000000 00000000 00000000"
                                            "03000000 02000000 BE730000");
    EXPECT_EQ(Wire(set.bytes().begin(), set.bytes().end()), set_by_hand);
}

TEST(ViperCodec, ReadsCommandAndReasonOfANak) {
    const Wire nak = wire::from_hex("56505243 1C000000 40E20100 07000000 04000000 FFFFFFFF 00000000"
                                    "01000000 2C340000");
    const ViperStep step = parse_viper(nak);
    const auto* reply = std::get_if<ViperReply>(&step.message);
    ASSERT_NE(reply, nullptr);
    EXPECT_EQ(reply->command, static_cast<std::uint32_t>(ViperCommand::Units));
    EXPECT_EQ(reply->action, static_cast<std::uint32_t>(ViperAction::Nak));
    ASSERT_EQ(reply->payload.size(), 4U);
    EXPECT_EQ(reply->payload[0], static_cast<std::byte>(ViperNak::Booting));
}

TEST(ViperCodec, RejectsAnyWrongBitAndReadsTheNextFrame) {
    const Wire next = wire::viper_frame(7, {wire::Pose{}, wire::Pose{2}});
    for (std::size_t bit = 0; bit < frame_by_hand.size() * 8; ++bit) {
        Wire stream = frame_by_hand;
        stream[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
        stream.insert(stream.end(), next.begin(), next.end());
        const ParsedStream parsed = parse_all(stream);
        EXPECT_GE(parsed.refusals, 1) << "bit " << bit;
        ASSERT_EQ(parsed.frames.size(), 1U) << "bit " << bit;
        EXPECT_EQ(parsed.frames[0].counter, 7U) << "bit " << bit;
        EXPECT_EQ(parsed.others, 0) << "bit " << bit;
    }
}

TEST(ViperCodec, WaitsForTheRestOfATruncatedFrame) {
    for (std::size_t cut = 0; cut < frame_by_hand.size(); ++cut) {
        const ParsedStream parsed = parse_all(std::span(frame_by_hand).first(cut));
        EXPECT_TRUE(parsed.frames.empty());
        EXPECT_EQ(parsed.refusals, 0) << cut;
        EXPECT_EQ(parsed.left, cut);
    }
}

TEST(ViperCodec, TruncatedFrameLosesOnlyItself) {
    const Wire next = wire::viper_frame(8, {wire::Pose{}});
    for (std::size_t cut = 1; cut < frame_by_hand.size(); ++cut) {
        Wire stream(frame_by_hand.begin(), frame_by_hand.begin() + static_cast<std::ptrdiff_t>(cut));
        stream.insert(stream.end(), next.begin(), next.end());
        stream.insert(stream.end(), next.begin(), next.end());
        const ParsedStream parsed = parse_all(stream);
        ASSERT_EQ(parsed.frames.size(), 2U) << "cut " << cut;
        EXPECT_EQ(parsed.frames[0].counter, 8U);
    }
}

TEST(ViperCodec, GarbageInFrontIsSkipped) {
    std::mt19937 engine(3);
    for (int length = 1; length < 300; ++length) {
        Wire stream;
        for (int k = 0; k < length; ++k) {
            // Letters of the preamble occur often.
            stream.push_back(static_cast<std::byte>("VPRPC\0\x34\xFF"[engine() % 8]));
        }
        stream.insert(stream.end(), frame_by_hand.begin(), frame_by_hand.end());
        // A random header may claim the following bytes; further frames end its wait.
        for (std::uint32_t k = 0; k < 40; ++k) {
            const Wire more = wire::viper_frame(k, {wire::Pose{}});
            stream.insert(stream.end(), more.begin(), more.end());
        }
        EXPECT_EQ(parse_all(stream).frames.size(), 41U) << length;
    }
}

TEST(ViperCodec, MarksInvalidPosesAsNotUsable) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    std::vector<wire::Pose> poses;
    for (const float bad : {nan, infinity, -infinity, 1e30F, 11.0F}) {
        for (std::size_t k = 0; k < 3; ++k) {
            poses.emplace_back();
            poses.back().position[k] = bad;
        }
    }
    for (const float bad : {nan, infinity, 3.0F}) {
        for (std::size_t k = 0; k < 4; ++k) {
            poses.emplace_back();
            poses.back().quaternion[k] = bad;
        }
    }
    poses.emplace_back();
    poses.back().quaternion = {};
    for (const wire::Pose& pose : poses) {
        const ParsedStream parsed = parse_all(wire::viper_frame(1, {pose, wire::Pose{2}}));
        ASSERT_EQ(parsed.frames.size(), 1U);
        EXPECT_FALSE(parsed.frames[0].sensors[0].usable);
        EXPECT_TRUE(parsed.frames[0].sensors[1].usable);
    }
}

TEST(ViperCodec, MarksPosesInOtherUnitsAsNotUsable) {
    for (unsigned position = 0; position < 4; ++position) {
        for (unsigned orientation = 0; orientation < 4; ++orientation) {
            wire::Pose pose;
            pose.position_units = position;
            pose.orientation_units = orientation;
            const ParsedStream parsed = parse_all(wire::viper_frame(1, {pose}));
            ASSERT_EQ(parsed.frames.size(), 1U);
            const bool as_set = position == 3 && orientation == 2;
            EXPECT_EQ(parsed.frames[0].units_as_set, as_set);
            EXPECT_EQ(parsed.frames[0].sensors[0].usable, as_set);
        }
    }
}

TEST(ViperCodec, SixteenSensorsAreReadAndSeventeenRefused) {
    std::vector<wire::Pose> poses(16);
    EXPECT_EQ(parse_all(wire::viper_frame(1, poses)).frames.at(0).count, 16U);
    poses.emplace_back();
    EXPECT_TRUE(parse_all(wire::viper_frame(1, poses)).frames.empty());
}

/// Each mutant is in memory of exactly its size, so the address sanitizer detects reads beyond it.
TEST(ViperCodec, MutatedStreamsGiveOnlyFramesThatWereSent) {
    Wire seed = frame_by_hand;
    for (const Wire& more : {wire::viper_reply(7, 3, wire::from_hex("03000000 02000000")),
                             wire::viper_frame(9, {{}, {2}, {3}})}) {
        seed.insert(seed.end(), more.begin(), more.end());
    }
    const std::size_t frames_in_seed = 2;
    std::mt19937 engine(20);
    for (int mutant = 0; mutant < 100'000; ++mutant) {
        Wire bytes = seed;
        const std::size_t changes = 1 + engine() % 4;
        for (std::size_t k = 0; k < changes && !bytes.empty(); ++k) {
            const auto at = static_cast<std::ptrdiff_t>(engine() % bytes.size());
            switch (engine() % 4) {
            case 0:
                bytes[static_cast<std::size_t>(at)] ^= static_cast<std::byte>(1U << engine() % 8);
                break;
            case 1:
                bytes[static_cast<std::size_t>(at)] = static_cast<std::byte>(engine());
                break;
            case 2:
                bytes.erase(bytes.begin() + at);
                break;
            default:
                bytes.resize(static_cast<std::size_t>(at));
            }
        }
        const Wire exact(bytes);
        const ParsedStream parsed = parse_all(exact);
        EXPECT_LE(parsed.frames.size(), frames_in_seed);
        for (const DeviceFrame& frame : parsed.frames) {
            EXPECT_TRUE(frame.counter == 0x01020304U || frame.counter == 9U) << "mutant " << mutant;
        }
    }
}

} // namespace
} // namespace frustumscreen::tracker
