#include "firmware_host/tracker/crc.h"
#include "firmware_host/tracker/packet_file.h"
#include "firmware_host/tracker/packet_replay.h"
#include "firmware_host/tracker/usb_tracker_driver.h"
#include "tests/tracker/bytes_in_document.h"
#include "tests/tracker/fake_usb_tracker.h"

#include <gtest/gtest.h>

#include <random>

namespace frustumscreen::tracker {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// The recording as the file would contain it.
class MemoryTap final : public PacketTap {
public:
    MemoryTap() { append_packet_header(file); }
    void packet(PacketKind kind, MonotonicTime time, std::span<const std::byte> payload) override {
        append_packet(file, {kind, time, payload});
        ends.push_back(file.size());
    }
    Bytes file;
    std::vector<std::size_t> ends; ///< end of each packet
};

struct Recorded {
    Bytes file;
    std::vector<std::size_t> ends;
    std::vector<PoseSample> samples; ///< produced by the driver while recording
    UsbTrackerState state = UsbTrackerState::NotConnected;
    TrackerCounts counts;
};

/// A recording of a device with every kind of event.
Recorded eventful(UsbTrackerModel model, Nanoseconds length) {
    FakeUsbTracker device;
    device.model = model;
    device.plugged = false;
    device.boots_until = device.now + seconds(1);
    std::mt19937 engine(11);
    device.mischief = [&](wire::Wire frame) -> std::vector<wire::Wire> {
        const std::size_t at = engine() % frame.size();
        switch (engine() % 20) {
        case 0:
            frame[at] ^= static_cast<std::byte>(1U << engine() % 8);
            return {frame};
        case 1:
            frame.resize(at);
            return {frame};
        case 2:
            return {};
        case 3:
            return {frame, frame};
        default:
            return {frame};
        }
    };
    MemoryTap tap;
    Recorded recorded;
    UsbTrackerDriver driver(
        std::make_unique<FakeBus>(device), {{0.0, 0.6, -0.8}, {0.3, 0.2}}, [&] { return device.now; }, &tap);
    const MonotonicTime start = device.now;
    while (device.now - start < length) {
        const Nanoseconds since = device.now - start;
        device.plugged = since > milliseconds(500) && (since < seconds(4) || since > seconds(5));
        device.mute = since > seconds(7) && since < seconds(9);
        device.distortion = since > seconds(10) && since < seconds(11) ? 100 : 0;
        if (!device.plugged) {
            device.restart();
        }
        device.now += driver.step(recorded.samples);
    }
    recorded.file = tap.file;
    recorded.ends = tap.ends;
    recorded.state = driver.state();
    recorded.counts = driver.counts();
    return recorded;
}

std::vector<PoseSample> replayed(Bytes file) {
    std::vector<PoseSample> samples;
    Result<PacketReplay> replay = PacketReplay::open(std::move(file), "test");
    EXPECT_TRUE(replay) << (replay ? "" : replay.error().message);
    if (replay) {
        replay->play(replay->end(), samples);
    }
    return samples;
}

bool same(const PoseSample& a, const PoseSample& b) {
    return a.time == b.time && a.station == b.station && a.position_m == b.position_m &&
           a.rotation == b.rotation && a.ok == b.ok;
}

const std::vector<UsbTrackerModel> models{UsbTrackerModel::Viper, UsbTrackerModel::Patriot,
                                          UsbTrackerModel::Hid};

TEST(PacketReplay, ReproducesTheRecordedSamples) {
    for (const UsbTrackerModel model : models) {
        const Recorded recorded = eventful(model, seconds(15));
        ASSERT_GT(recorded.samples.size(), 500U);
        const std::vector<PoseSample> again = replayed(recorded.file);
        ASSERT_EQ(again.size(), recorded.samples.size());
        for (std::size_t k = 0; k < again.size(); ++k) {
            ASSERT_TRUE(same(again[k], recorded.samples[k])) << k;
        }
    }
}

TEST(PacketReplay, GivesTheSameSamplesForAnyStepAndAfterRewind) {
    const Recorded recorded = eventful(UsbTrackerModel::Viper, seconds(8));
    Result<PacketReplay> replay = PacketReplay::open(recorded.file, "test");
    ASSERT_TRUE(replay);
    for (const Nanoseconds step : {milliseconds(1), milliseconds(170)}) {
        std::vector<PoseSample> samples;
        for (MonotonicTime now = replay->begin(); now < replay->end() + step; now += step) {
            replay->play(now, samples);
        }
        ASSERT_EQ(samples.size(), recorded.samples.size());
        EXPECT_TRUE(same(samples.back(), recorded.samples.back()));
        EXPECT_EQ(replay->state(), sentence_of(recorded.state));
        replay->rewind();
    }
}

TEST(PacketReplay, ReproducesTheRecordedCounts) {
    const Recorded recorded = eventful(UsbTrackerModel::Viper, seconds(15));
    Result<PacketReplay> replay = PacketReplay::open(recorded.file, "test");
    ASSERT_TRUE(replay);
    std::vector<PoseSample> samples;
    for (int round = 0; round < 2; ++round) {
        replay->play(replay->end(), samples);
        const TrackerCounts counts = replay->counts();
        EXPECT_GT(counts.connections, 1U);
        EXPECT_EQ(counts.connections, recorded.counts.connections);
        EXPECT_EQ(counts.frames, recorded.counts.frames);
        EXPECT_EQ(counts.lost, recorded.counts.lost);
        EXPECT_EQ(counts.broken, recorded.counts.broken);
        EXPECT_EQ(counts.clock_drift, recorded.counts.clock_drift);
        replay->rewind();
    }
}

TEST(PacketReplay, ReproducesTheRecordedStates) {
    const Recorded recorded = eventful(UsbTrackerModel::Viper, seconds(15));
    Result<PacketReplay> replay = PacketReplay::open(recorded.file, "test");
    ASSERT_TRUE(replay);
    std::vector<PoseSample> samples;
    const auto state_at = [&](Nanoseconds since) {
        replay->play(replay->begin() + since, samples);
        return std::string(replay->state());
    };
    EXPECT_EQ(state_at(milliseconds(300)), sentence_of(UsbTrackerState::NotConnected));
    EXPECT_EQ(state_at(milliseconds(950)), sentence_of(UsbTrackerState::Booting));
    EXPECT_EQ(state_at(milliseconds(3900)), sentence_of(UsbTrackerState::Streaming));
    EXPECT_EQ(state_at(milliseconds(4900)), sentence_of(UsbTrackerState::NotConnected));
    EXPECT_EQ(state_at(milliseconds(8500)), sentence_of(UsbTrackerState::Silent));
    EXPECT_EQ(state_at(milliseconds(10900)), sentence_of(UsbTrackerState::MetalNear));
}

TEST(PacketReplay, SpaceMouseRecordingIsInTheTableFrame) {
    MemoryTap tap;
    const MonotonicTime start = from_microseconds(77);
    const UsbTrackerSetUp set_up{{1.0, 0.0, 0.0}, {0.3, 0.2}};
    tap.packet(PacketKind::Opened, start, OpenedDevice{UsbTrackerModel::SpaceMouse, set_up}.bytes());
    for (int k = 0; k < 1000; ++k) {
        tap.packet(PacketKind::Received, start + milliseconds(10 * k),
                   k % 10 == 0 ? wire::Wire() : wire::space_mouse(1, {350, 0, 0}));
    }
    Result<PacketReplay> replay = PacketReplay::open(tap.file, "test");
    ASSERT_TRUE(replay);
    EXPECT_TRUE(replay->reports_table_frame());
    std::vector<PoseSample> samples;
    replay->play(replay->end(), samples);
    EXPECT_EQ(samples.size(), 9990U / 8U + 1U);
    EXPECT_EQ(samples.back().position_m, glm::dvec3(0.3, 0.0, 0.0)); // on the table of the recording
}

/// Tests every length of the file, as a power cut may leave it.
TEST(PacketReplay, PlaysATruncatedRecordingUpToTheCut) {
    const Recorded recorded = eventful(UsbTrackerModel::Hid, milliseconds(2500));
    const std::vector<PoseSample> all = replayed(recorded.file);
    const std::size_t first_device = recorded.ends[3];
    std::size_t whole = 0;
    std::size_t before = 0;
    for (std::size_t length = 0; length <= recorded.file.size(); length += length < 400 ? 1 : 7) {
        const Bytes cut(recorded.file.begin(), recorded.file.begin() + static_cast<std::ptrdiff_t>(length));
        const Result<PacketReader> reader = PacketReader::open(cut, "cut");
        ASSERT_EQ(reader.has_value(), length >= 16);
        if (!reader) {
            continue;
        }
        PacketReader packets = *reader;
        std::size_t count = 0;
        while (packets.next()) {
            ++count;
        }
        while (whole < recorded.ends.size() && recorded.ends[whole] <= length) {
            ++whole;
        }
        ASSERT_EQ(count, whole) << length;
        ASSERT_EQ(packets.left(), length - (whole == 0 ? 16 : recorded.ends[whole - 1]));
        if (length > first_device && length % 50 < 7) {
            const std::vector<PoseSample> some = replayed(cut);
            ASSERT_GE(some.size(), before);
            ASSERT_LE(some.size(), all.size());
            ASSERT_TRUE(some.empty() || same(some.back(), all[some.size() - 1]));
            before = some.size();
        }
    }
    EXPECT_GT(before, 100U);
}

TEST(PacketFile, ChecksumIsTheStandardCrc32) {
    EXPECT_EQ(crc32_ieee(as_bytes("123456789")), 0xCBF43926U);
    EXPECT_EQ(crc32_ieee({}), 0U);
}

TEST(PacketFile, ReadsTheDocumentsExample) {
    const wire::Wire file = wire::bytes_in_document("packet_recording.md", "46 53 50 41");
    Result<PacketReader> reader = PacketReader::open(file, "test");
    ASSERT_TRUE(reader);
    const std::optional<Packet> packet = reader->next();
    ASSERT_TRUE(packet);
    EXPECT_EQ(packet->kind, PacketKind::State);
    EXPECT_EQ(packet->time, from_microseconds(1'000'000));
    EXPECT_EQ(as_text(packet->payload), "hello");
    EXPECT_EQ(reader->left(), 0U);
    Bytes written;
    append_packet_header(written);
    append_packet(written, *packet);
    EXPECT_EQ(written, file);
}

TEST(PacketFile, AnyChangedBitEndsTheRecordingAtItsPacket) {
    MemoryTap tap;
    const std::array<std::byte, 3> payload{std::byte{1}, std::byte{2}, std::byte{3}};
    for (int k = 0; k < 3; ++k) {
        tap.packet(PacketKind::Received, from_microseconds(k), payload);
    }
    for (std::size_t bit = 8 * 16; bit < 8 * tap.file.size(); ++bit) {
        Bytes changed = tap.file;
        changed[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
        PacketReader reader = *PacketReader::open(changed, "test");
        std::size_t count = 0;
        while (const std::optional<Packet> packet = reader.next()) {
            EXPECT_TRUE(
                std::equal(payload.begin(), payload.end(), packet->payload.begin(), packet->payload.end()));
            ++count;
        }
        const std::size_t damaged = (bit / 8 - 16) / packet_size(payload.size());
        EXPECT_EQ(count, damaged) << bit;
    }
}

TEST(PacketFile, RejectsFilesThatAreNotRecordings) {
    const std::string csv = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n";
    EXPECT_FALSE(is_packet_recording(as_bytes(csv)));
    EXPECT_NE(
        PacketReader::open(as_bytes(csv), "a.csv").error().message.find("a.csv: this is not a recording"),
        std::string::npos);
    Bytes later;
    append_packet_header(later);
    later[8] = std::byte{2};
    EXPECT_NE(PacketReader::open(later, "b").error().message.find("version 2"), std::string::npos);
    Bytes empty;
    append_packet_header(empty);
    EXPECT_NE(PacketReplay::open(empty, "c").error().message.find("c: no tracker was found"),
              std::string::npos);
}

TEST(PacketFile, SkipsUnknownPacketsAndKeepsTimeMonotonic) {
    Bytes file;
    append_packet_header(file);
    append_packet(file, {PacketKind::State, from_microseconds(50), {}});
    append_packet(file, {static_cast<PacketKind>(99), from_microseconds(60), {}});
    append_packet(file, {PacketKind::Closed, from_microseconds(10), {}});
    PacketReader reader = *PacketReader::open(file, "test");
    EXPECT_EQ(reader.next()->kind, PacketKind::State);
    const std::optional<Packet> last = reader.next();
    EXPECT_EQ(last->kind, PacketKind::Closed);
    EXPECT_EQ(last->time, from_microseconds(60));
    EXPECT_FALSE(reader.next());
    EXPECT_EQ(reader.left(), 0U);
}

TEST(PacketReplay, MutatedPacketsGiveOnlyValidPoses) {
    std::mt19937 engine(12);
    std::size_t poses = 0;
    for (const UsbTrackerModel model : models) {
        const Recorded recorded = eventful(model, seconds(3));
        for (int round = 0; round < 20; ++round) {
            Bytes mutated;
            append_packet_header(mutated);
            PacketReader reader = *PacketReader::open(recorded.file, "test");
            while (const std::optional<Packet> packet = reader.next()) {
                Bytes payload(packet->payload.begin(), packet->payload.end());
                PacketKind kind = packet->kind;
                Nanoseconds shift{0};
                if (engine() % 20 == 0 && !payload.empty()) {
                    payload[engine() % payload.size()] = static_cast<std::byte>(engine());
                } else if (engine() % 50 == 0) {
                    payload.resize(engine() % 100);
                } else if (engine() % 50 == 0) {
                    kind = static_cast<PacketKind>(1 + engine() % 9);
                } else if (engine() % 200 == 0) {
                    shift = Nanoseconds(static_cast<std::int64_t>(engine()) * (1 + engine() % 1000));
                }
                append_packet(mutated, {kind, packet->time + shift, payload});
            }
            Result<PacketReplay> replay = PacketReplay::open(mutated, "test");
            if (!replay) {
                continue;
            }
            std::vector<PoseSample> samples;
            replay->play(replay->end(), samples);
            poses += samples.size();
            for (const PoseSample& sample : samples) {
                ASSERT_TRUE(is_pose(sample.position_m, sample.rotation));
            }
        }
    }
    EXPECT_GT(poses, 1000U);
}

TEST(PacketReplayTracker, PlaysAtAnySpeedAndAgain) {
    const Recorded recorded = eventful(UsbTrackerModel::Viper, seconds(6));
    const MonotonicTime start = from_microseconds(1'000'000'000);
    for (const double speed : {0.5, 1.0, 8.0}) {
        Result<PacketReplay> replay = PacketReplay::open(recorded.file, "test");
        ASSERT_TRUE(replay);
        const MonotonicTime begin = replay->begin();
        const Nanoseconds length((replay->end() - begin).count());
        PacketReplayTracker tracker(std::move(*replay), start, speed);
        EXPECT_FALSE(tracker.reports_table_frame());
        for (int round = 0; round < 2; ++round) {
            std::vector<PoseSample> samples;
            const auto in_ours = [&](Nanoseconds since) {
                return Nanoseconds(std::llround(static_cast<double>(since.count()) / speed));
            };
            const MonotonicTime round_start = start + round * (in_ours(length) + seconds(1));
            for (MonotonicTime now = round_start; now < round_start + in_ours(length) + milliseconds(20);
                 now += milliseconds(16)) {
                const std::size_t before = samples.size();
                ASSERT_TRUE(tracker.poll(now, samples));
                for (std::size_t k = before; k < samples.size(); ++k) {
                    ASSERT_LE(samples[k].time, now);
                    ASSERT_TRUE(k == 0 || samples[k - 1].time <= samples[k].time);
                }
            }
            ASSERT_EQ(samples.size(), recorded.samples.size()) << speed << " " << round;
            for (std::size_t k = 0; k < samples.size(); ++k) {
                ASSERT_EQ(samples[k].position_m, recorded.samples[k].position_m);
                const Nanoseconds expected = in_ours(recorded.samples[k].time - begin);
                ASSERT_LT(std::abs((samples[k].time - round_start - expected).count()), 1000);
            }
        }
    }
}

TEST(PacketReplayTracker, SurvivesARecordingOfCenturiesAtAnySpeed) {
    for (const double speed : {0.01, 1.0, 100.0}) {
        MemoryTap tap;
        tap.packet(PacketKind::Opened, from_microseconds(0),
                   OpenedDevice{UsbTrackerModel::SpaceMouse, {}}.bytes());
        tap.packet(PacketKind::Received, MonotonicTime::max(), wire::space_mouse(1, {350, 0, 0}));
        Result<PacketReplay> replay = PacketReplay::open(tap.file, "test");
        ASSERT_TRUE(replay);
        PacketReplayTracker tracker(std::move(*replay), from_microseconds(0), speed);
        std::vector<PoseSample> samples;
        for (int hour = 0; hour < 100; ++hour) {
            ASSERT_TRUE(tracker.poll(from_microseconds(0) + std::chrono::hours(hour), samples));
        }
        EXPECT_TRUE(samples.empty());
    }
}

TEST(PacketReplayTracker, SkipsMissedRounds) {
    const Recorded recorded = eventful(UsbTrackerModel::Hid, seconds(3));
    Result<PacketReplay> replay = PacketReplay::open(recorded.file, "test");
    ASSERT_TRUE(replay);
    PacketReplayTracker tracker(std::move(*replay), from_microseconds(0), 1.0);
    std::vector<PoseSample> samples;
    ASSERT_TRUE(tracker.poll(from_microseconds(0) + std::chrono::hours(24 * 365), samples));
    EXPECT_FALSE(samples.empty());
    EXPECT_LE(samples.size(), recorded.samples.size());
}

} // namespace
} // namespace frustumscreen::tracker
