// Recordings of packets: written again they read equal, and their replay gives finite poses, which do not
// depend on whether it is played at once or in steps. packets_mutator.cpp corrects the checksums.
#include "firmware_host/tracker/packet_replay.h"
#include "tests/fuzz/fuzz.h"

#include <algorithm>

using namespace frustumscreen;

namespace {

bool same(const tracker::Packet& a, const tracker::Packet& b) {
    return a.kind == b.kind && a.time == b.time && std::ranges::equal(a.payload, b.payload);
}

void check_packets(std::span<const std::byte> file) {
    auto reader = tracker::PacketReader::open(file, "packets");
    if (!reader) {
        fuzz::require_one_line(reader.error().message);
        return;
    }
    Bytes written;
    tracker::append_packet_header(written);
    std::vector<tracker::Packet> packets;
    while (const auto packet = reader->next()) {
        fuzz::require(packets.empty() || packets.back().time <= packet->time, "times do not go back");
        packets.push_back(*packet);
        tracker::append_packet(written, *packet);
    }
    fuzz::require(reader->left() <= file.size(), "what is left is part of the file");
    auto again = tracker::PacketReader::open(written, "again");
    fuzz::require(again.has_value(), "what was written is read");
    for (const tracker::Packet& packet : packets) {
        const auto read = again->next();
        fuzz::require(read && same(packet, *read), "a packet written again reads the same");
    }
    fuzz::require(!again->next() && again->left() == 0, "nothing is added");
}

void require_sound(const std::vector<tracker::PoseSample>& samples) {
    for (const tracker::PoseSample& sample : samples) {
        fuzz::require(fuzz::is_finite(sample.position_m) && fuzz::is_unit(sample.rotation),
                      "a pose is finite");
    }
}

bool same_samples(const std::vector<tracker::PoseSample>& a, const std::vector<tracker::PoseSample>& b) {
    return std::ranges::equal(a, b, [](const tracker::PoseSample& p, const tracker::PoseSample& q) {
        return p.time == q.time && p.station == q.station && p.ok == q.ok && p.position_m == q.position_m &&
               p.rotation == q.rotation;
    });
}

void check_replay(Bytes file) {
    auto replay = tracker::PacketReplay::open(std::move(file), "packets");
    if (!replay) {
        fuzz::require_one_line(replay.error().message);
        return;
    }
    std::vector<tracker::PoseSample> at_once;
    replay->play(replay->end(), at_once);
    require_sound(at_once);
    replay->rewind();
    std::vector<tracker::PoseSample> bit_by_bit;
    constexpr int steps = 16;
    for (int k = 0; k <= steps; ++k) {
        replay->play(replay->begin() + (replay->end() - replay->begin()) / steps * k, bit_by_bit);
    }
    replay->play(replay->end(), bit_by_bit);
    fuzz::require(same_samples(at_once, bit_by_bit), "a replay does not depend on how it is asked for");
}

/// `speed`: the slowest or the fastest that settings allow.
void check_tracker(const Bytes& file, double speed) {
    auto replay = tracker::PacketReplay::open(file, "packets");
    if (!replay) {
        return;
    }
    MonotonicTime now = from_microseconds(1'000'000);
    tracker::PacketReplayTracker tracker(std::move(*replay), now, speed);
    MonotonicTime latest = now;
    for (int k = 0; k < 32; ++k, now += std::chrono::milliseconds(1 << k % 16)) {
        std::vector<tracker::PoseSample> samples;
        fuzz::require(tracker.poll(now, samples).has_value(), "a replay has no errors");
        require_sound(samples);
        for (const tracker::PoseSample& sample : samples) {
            // Packets with equal times are set apart by microseconds, and slowed a hundredfold.
            fuzz::require(sample.time <= now && sample.time >= latest - std::chrono::seconds(1),
                          "a sample is not from the future, nor from before the replay");
            latest = sample.time;
        }
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span<const std::byte> file = fuzz::bytes_of(data, size);
    const Bytes copy(file.begin(), file.end());
    check_packets(file);
    check_replay(copy);
    check_tracker(copy, 0.01);
    check_tracker(copy, 100.0);
    return 0;
}
