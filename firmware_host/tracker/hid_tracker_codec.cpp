#include "firmware_host/tracker/hid_tracker_codec.h"

#include "firmware_host/base/byte_reader.h"
#include "firmware_host/tracker/crc.h"

namespace frustumscreen::tracker {

namespace {

constexpr std::uint8_t pose_report = 1;
constexpr std::size_t pose_bytes = 34;
constexpr std::size_t info_bytes = 10;
constexpr std::size_t crc_bytes = 2;

constexpr unsigned sensor_missing = 1U << 0U;
constexpr unsigned device_starting = 1U << 1U;
constexpr unsigned device_fault = 1U << 2U;
constexpr unsigned known_flags = sensor_missing | device_starting | device_fault;

constexpr double metres_per_unit = 1e-5;
constexpr double quaternion_scale = 32767.0;

bool has_good_crc(std::span<const std::byte> report) {
    const auto crc = ByteReader(report.last(crc_bytes)).read<std::uint16_t>();
    return crc == crc16_arc(report.first(report.size() - crc_bytes));
}

HidTrackerMessage parse_pose(ByteReader reader) {
    HidTrackerPose message;
    DeviceFrame& frame = message.frame;
    frame.count = 1;
    SensorPose& pose = frame.sensors[0];
    pose.sensor = reader.read<std::uint8_t>();
    const unsigned status = reader.read<std::uint8_t>();
    pose.distortion = reader.read<std::uint8_t>();
    frame.counter = reader.read<std::uint32_t>();
    frame.tick = reader.read<std::uint32_t>();
    for (int axis = 0; axis < 3; ++axis) {
        pose.position_m[axis] = metres_per_unit * reader.read<std::int32_t>();
    }
    std::array<double, 4> wxyz{};
    for (double& component : wxyz) {
        component = reader.read<std::int16_t>() / quaternion_scale;
    }
    pose.rotation = glm::dquat(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
    if (pose.sensor < 1 || pose.sensor > static_cast<int>(DeviceFrame::max_sensors) ||
        (status & ~known_flags) != 0) {
        return DiscardReason::Content;
    }
    message.starting = (status & device_starting) != 0;
    frame.fault = (status & device_fault) != 0;
    pose.present = (status & sensor_missing) == 0;
    pose.usable = status == 0 && is_pose(pose.position_m, pose.rotation);
    return message;
}

HidTrackerMessage parse_info(ByteReader reader) {
    HidTrackerInfo info;
    info.version = reader.read<std::uint8_t>();
    info.position_unit_um = reader.read<std::uint16_t>();
    info.rate_hz = reader.read<std::uint16_t>();
    info.stations = reader.read<std::uint8_t>();
    return info;
}

} // namespace

HidTrackerMessage parse_hid_tracker(std::span<const std::byte> report) {
    ByteReader reader(report);
    const auto id = reader.read<std::uint8_t>();
    if (!reader.ok() || (id != pose_report && id != hid_tracker_info_report)) {
        return DiscardReason::Garbage;
    }
    if (report.size() != (id == pose_report ? pose_bytes : info_bytes)) {
        return DiscardReason::Length;
    }
    if (!has_good_crc(report)) {
        return DiscardReason::Checksum;
    }
    return id == pose_report ? parse_pose(reader) : parse_info(reader);
}

} // namespace frustumscreen::tracker
