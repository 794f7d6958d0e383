#include "firmware_host/tracker/hid_ids.h"
#include "firmware_host/tracker/hid_tracker_codec.h"
#include "tests/tracker/bytes_in_document.h"
#include "tests/tracker/wire_bytes.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace frustumscreen::tracker {
namespace {

using wire::bytes_in_document;

const HidTrackerPose* pose_of(const HidTrackerMessage& message) {
    return std::get_if<HidTrackerPose>(&message);
}

TEST(HidTrackerCodec, ReadsTheDocumentsPose) {
    const wire::Wire report = bytes_in_document("hid_tracker.md", "01 01 00 00 E8");
    ASSERT_EQ(report.size(), 34U);
    const HidTrackerMessage message = parse_hid_tracker(report);
    const HidTrackerPose* pose = pose_of(message);
    ASSERT_NE(pose, nullptr);
    const SensorPose& sensor = pose->frame.sensors[0];
    EXPECT_EQ(pose->frame.count, 1U);
    EXPECT_EQ(sensor.sensor, 1);
    EXPECT_TRUE(sensor.usable && sensor.present && !pose->starting && !pose->frame.fault);
    EXPECT_EQ(pose->frame.counter, 1000U);
    EXPECT_EQ(pose->frame.tick, 2'000'000U);
    EXPECT_LT(glm::distance(sensor.position_m, glm::dvec3(0.1, -0.05, 0.12)), 1e-15);
    const glm::dvec3 turned = glm::normalize(sensor.rotation) * glm::dvec3(1, 0, 0);
    EXPECT_LT(glm::distance(turned, glm::dvec3(0, 1, 0)), 1e-12);
}

TEST(HidTrackerCodec, ReadsTheDocumentsDevice) {
    const HidTrackerMessage message = parse_hid_tracker(bytes_in_document("hid_tracker.md", "02 01"));
    const auto* info = std::get_if<HidTrackerInfo>(&message);
    ASSERT_NE(info, nullptr);
    EXPECT_EQ(info->version, hid_tracker_version);
    EXPECT_EQ(info->position_unit_um, 10);
    EXPECT_EQ(info->rate_hz, 120);
    EXPECT_EQ(info->stations, 2);
}

/// Short items of the HID specification 1.11, 6.2.2: a host's interpretation of the document's descriptor.
struct Described {
    std::map<unsigned, unsigned> input_bits;   ///< by report id
    std::map<unsigned, unsigned> feature_bits; ///< by report id
    unsigned usage_page = 0;
    unsigned usage = 0; ///< of the first collection
    int depth = 0;
};

Described described(const wire::Wire& descriptor) {
    Described found;
    unsigned size = 0;
    unsigned count = 0;
    unsigned id = 0;
    unsigned usage = 0;
    for (std::size_t at = 0; at < descriptor.size();) {
        const auto prefix = static_cast<unsigned>(descriptor[at]);
        const std::size_t length = (prefix & 3U) == 3 ? 4 : prefix & 3U;
        unsigned value = 0;
        for (std::size_t k = 0; k < length && at + 1 + k < descriptor.size(); ++k) {
            value |= static_cast<unsigned>(descriptor[at + 1 + k]) << (8 * k);
        }
        switch (prefix & 0xFCU) {
        case 0x04:
            found.usage_page = value;
            break;
        case 0x08:
            usage = value;
            break;
        case 0x74:
            size = value;
            break;
        case 0x84:
            id = value;
            break;
        case 0x94:
            count = value;
            break;
        case 0x80:
            found.input_bits[id] += size * count;
            break;
        case 0xB0:
            found.feature_bits[id] += size * count;
            break;
        case 0xA0:
            found.usage = found.depth++ == 0 ? usage : found.usage;
            break;
        case 0xC0:
            --found.depth;
            break;
        default: // logical limits, units
            EXPECT_TRUE((prefix & 0xFCU) == 0x14 || (prefix & 0xFCU) == 0x24 || (prefix & 0xFCU) == 0x54 ||
                        (prefix & 0xFCU) == 0x64)
                << prefix;
        }
        at += 1 + length;
    }
    return found;
}

TEST(HidTrackerCodec, TheDocumentsDescriptorDescribesTheReports) {
    const Described device = described(bytes_in_document("hid_tracker.md", "06 46 FF"));
    EXPECT_EQ(device.usage_page, hid_tracker_usage_page);
    EXPECT_EQ(device.usage, hid_tracker_usage);
    EXPECT_EQ(device.depth, 0);
    EXPECT_EQ(device.input_bits, (std::map<unsigned, unsigned>{{1, 33 * 8}})); // without the id
    EXPECT_EQ(device.feature_bits, (std::map<unsigned, unsigned>{{2, 9 * 8}}));
}

TEST(HidTrackerCodec, EveryStatusBitMakesThePoseUnusable) {
    for (unsigned bit = 0; bit < 8; ++bit) {
        wire::HidPose sent;
        sent.status = 1U << bit;
        const HidTrackerMessage message = parse_hid_tracker(wire::hid_pose(sent));
        const HidTrackerPose* pose = pose_of(message);
        ASSERT_EQ(pose != nullptr, bit < 3) << bit; // the other bits do not exist in this version
        if (pose != nullptr) {
            EXPECT_FALSE(pose->frame.sensors[0].usable);
            EXPECT_EQ(pose->frame.sensors[0].present, bit != 0);
            EXPECT_EQ(pose->starting, bit == 1);
            EXPECT_EQ(pose->frame.fault, bit == 2);
        }
    }
}

TEST(HidTrackerCodec, MarksInvalidPosesAndRejectsInvalidStations) {
    wire::HidPose far;
    far.position[2] = 1'100'000; // 11 m
    wire::HidPose still = {};
    still.quaternion = {};
    wire::HidPose short_one = {};
    short_one.quaternion = {16000, 16000, -16000, 16000};
    for (const wire::HidPose& sent : {far, still, short_one}) {
        const HidTrackerMessage message = parse_hid_tracker(wire::hid_pose(sent));
        ASSERT_NE(pose_of(message), nullptr);
        EXPECT_FALSE(pose_of(message)->frame.sensors[0].usable);
    }
    wire::HidPose strange;
    strange.station = 17;
    EXPECT_EQ(std::get<DiscardReason>(parse_hid_tracker(wire::hid_pose(strange))), DiscardReason::Content);
    strange.station = 0;
    EXPECT_EQ(std::get<DiscardReason>(parse_hid_tracker(wire::hid_pose(strange))), DiscardReason::Content);
}

TEST(HidTrackerCodec, RejectsAnyChangedBitOrOtherLength) {
    for (const wire::Wire& good : {wire::hid_pose({}), wire::hid_info()}) {
        for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
            wire::Wire changed = good;
            changed[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
            EXPECT_TRUE(std::holds_alternative<DiscardReason>(parse_hid_tracker(changed))) << bit;
        }
        for (std::size_t length = 0; length < good.size(); ++length) {
            const std::span<const std::byte> cut(good.data(), length);
            EXPECT_TRUE(std::holds_alternative<DiscardReason>(parse_hid_tracker(cut))) << length;
        }
        wire::Wire longer = good;
        longer.push_back(std::byte{0});
        EXPECT_EQ(std::get<DiscardReason>(parse_hid_tracker(longer)), DiscardReason::Length);
    }
}

TEST(HidTrackerCodec, MutatedReportsGiveOnlyValidPoses) {
    std::mt19937 engine(3);
    for (int round = 0; round < 20'000; ++round) {
        wire::Wire report = engine() % 2 == 0 ? wire::hid_pose({}) : wire::hid_info();
        report.pop_back(); // removes the checksum
        report.pop_back();
        for (int k = 0; k < 4; ++k) {
            report[1 + engine() % (report.size() - 1)] = static_cast<std::byte>(engine());
        }
        const HidTrackerMessage message = parse_hid_tracker(wire::with_crc16(report)); // with a valid
                                                                                       // checksum
        if (const HidTrackerPose* pose = pose_of(message); pose != nullptr && pose->frame.sensors[0].usable) {
            EXPECT_TRUE(is_pose(pose->frame.sensors[0].position_m, pose->frame.sensors[0].rotation));
        }
    }
}

TEST(HidIds, RecognizeTrackersByUsageAndSpaceMiceByVendor) {
    EXPECT_EQ(known_hid_tracker({0x1209, 0x0001, 0xFF46, 0x53}), UsbTrackerModel::Hid);
    EXPECT_EQ(known_hid_tracker({0x1209, 0x0001, 0xFF46, 0x54}), std::nullopt);
    EXPECT_EQ(known_hid_tracker({0x256f, 0xc635, 0x01, 0x08}), UsbTrackerModel::SpaceMouse);
    EXPECT_EQ(known_hid_tracker({0x046d, 0xc626, 0x01, 0x08}), UsbTrackerModel::SpaceMouse);
    EXPECT_EQ(known_hid_tracker({0x046d, 0xc52b, 0x01, 0x08}), std::nullopt); // a receiver for mice
    EXPECT_EQ(known_hid_tracker({0x256f, 0xc635, 0x01, 0x06}), std::nullopt); // its keys
    EXPECT_EQ(known_hid_tracker({0x045e, 0x0001, 0x01, 0x08}), std::nullopt);
}

} // namespace
} // namespace frustumscreen::tracker
