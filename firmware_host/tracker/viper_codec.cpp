#include "firmware_host/tracker/viper_codec.h"

#include "firmware_host/base/byte_reader.h"

#include <algorithm>
#include <cassert>

namespace frustumscreen::tracker {

namespace {

constexpr std::uint32_t pose_preamble = 0x50525056;    // "VPRP"
constexpr std::uint32_t command_preamble = 0x43525056; // "VPRC"
constexpr std::size_t header_bytes = 8;
constexpr std::size_t crc_bytes = 4;
constexpr std::size_t pose_head_bytes = 16;
constexpr std::size_t sensor_bytes = 32;
constexpr std::size_t command_head_bytes = 20;
constexpr std::uint32_t standard_mode = 0; ///< the other mode has accelerations and shorter quaternions
/// The longest known reply is a single pose of 16 sensors.
constexpr std::size_t max_reply_payload = 1024;

std::uint32_t u32_at(std::span<const std::byte> bytes, std::size_t offset) {
    return ByteReader(bytes.subspan(offset)).read<std::uint32_t>();
}

bool is_preamble(std::uint32_t word) {
    return word == pose_preamble || word == command_preamble;
}

/// Bytes before the next place where a preamble stands or may begin; at least 1.
std::size_t bytes_to_next_preamble(std::span<const std::byte> stream) {
    for (std::size_t at = 1; at < stream.size(); ++at) {
        const std::size_t left = std::min<std::size_t>(stream.size() - at, 4);
        for (const std::uint32_t preamble : {pose_preamble, command_preamble}) {
            if (std::memcmp(stream.data() + at, &preamble, left) == 0) {
                return at;
            }
        }
    }
    return stream.size();
}

ViperStep refuse(std::span<const std::byte> stream, DiscardReason refusal) {
    return {bytes_to_next_preamble(stream), refusal};
}

/// The info word, least significant bits first: sensor 7, virtual 1, position units 2, orientation units 2,
/// buttons 2, distortion 8, aux 10 bits.
SensorPose sensor_pose(ByteReader& reader, bool& units_as_set) {
    const auto info = reader.read<std::uint32_t>();
    const bool is_virtual = (info >> 7U & 1U) != 0;
    units_as_set =
        units_as_set && (info >> 8U & 3U) == viper_metres && (info >> 10U & 3U) == viper_quaternion;
    std::array<double, 7> numbers{};
    for (double& number : numbers) {
        number = static_cast<double>(reader.read<float>());
    }
    SensorPose pose;
    pose.sensor = static_cast<int>(info & 0x7FU) + 1;
    pose.position_m = {numbers[0], numbers[1], numbers[2]};
    pose.rotation = glm::dquat(numbers[3], numbers[4], numbers[5], numbers[6]);
    pose.distortion = static_cast<int>(info >> 14U & 0xFFU);
    pose.usable = units_as_set && !is_virtual && is_pose(pose.position_m, pose.rotation);
    return pose;
}

DeviceFrame pose_frame(std::span<const std::byte> body) {
    ByteReader reader(body);
    DeviceFrame frame;
    static_cast<void>(reader.read<std::uint32_t>()); // serial
    frame.counter = reader.read<std::uint32_t>();
    frame.tick = frame.counter;
    const auto info = reader.read<std::uint32_t>(); // least significant first: mode 4, built-in test 4 bits
    frame.units_as_set = (info & 0xFU) == standard_mode;
    frame.fault = (info >> 4U & 0xFU) != 0;
    frame.count = reader.read<std::uint32_t>();
    for (std::size_t k = 0; k < frame.count; ++k) {
        frame.sensors[k] = sensor_pose(reader, frame.units_as_set);
    }
    return frame;
}

} // namespace

ViperStep parse_viper(std::span<const std::byte> stream) {
    if (stream.empty()) {
        return {};
    }
    if (stream.size() < header_bytes) {
        const std::size_t known = std::min<std::size_t>(stream.size(), 4);
        const bool may_be = std::memcmp(stream.data(), &pose_preamble, known) == 0 ||
                            std::memcmp(stream.data(), &command_preamble, known) == 0;
        return may_be ? ViperStep{} : refuse(stream, DiscardReason::Garbage);
    }
    const std::uint32_t preamble = u32_at(stream, 0);
    if (!is_preamble(preamble)) {
        return refuse(stream, DiscardReason::Garbage);
    }
    const bool poses = preamble == pose_preamble;
    const std::size_t size = u32_at(stream, 4);
    const std::size_t head = poses ? pose_head_bytes : command_head_bytes;
    const std::size_t most = poses ? DeviceFrame::max_sensors * sensor_bytes : max_reply_payload;
    if (size < head + crc_bytes || size > head + most + crc_bytes) {
        return refuse(stream, DiscardReason::Length);
    }
    // The sensor count implies the size, so a wrong size is found before the parser waits for the frame's
    // end.
    if (poses && stream.size() >= header_bytes + pose_head_bytes) {
        const std::size_t count = u32_at(stream, header_bytes + 12);
        if (count > DeviceFrame::max_sensors || size != head + count * sensor_bytes + crc_bytes) {
            return refuse(stream, DiscardReason::Length);
        }
    }
    const std::size_t whole = header_bytes + size;
    if (stream.size() < whole) {
        return {};
    }
    if (u32_at(stream, whole - crc_bytes) != crc16_arc(stream.first(whole - crc_bytes))) {
        return refuse(stream, DiscardReason::Checksum);
    }
    const std::span<const std::byte> body = stream.subspan(header_bytes, size - crc_bytes);
    if (poses) {
        return {whole, pose_frame(body)};
    }
    return {whole, ViperReply{u32_at(body, 4), u32_at(body, 8), body.subspan(command_head_bytes)}};
}

ViperCommandBytes::ViperCommandBytes(ViperCommand command, ViperAction action,
                                     std::span<const std::byte> payload, std::uint32_t sensor,
                                     ViperFilterTarget target) {
    assert(payload.size() <= max_payload);
    const auto put = [this](std::uint32_t word) {
        std::memcpy(bytes_.data() + size_, &word, sizeof(word));
        size_ += sizeof(word);
    };
    put(command_preamble);
    put(static_cast<std::uint32_t>(command_head_bytes + payload.size() + crc_bytes));
    put(0xFFFFFFFFU); // any device
    put(static_cast<std::uint32_t>(command));
    put(static_cast<std::uint32_t>(action));
    put(sensor);
    put(static_cast<std::uint32_t>(target));
    std::copy(payload.begin(), payload.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += payload.size();
    put(crc16_arc(bytes()));
}

} // namespace frustumscreen::tracker
