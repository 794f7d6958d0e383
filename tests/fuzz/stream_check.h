/// The promises of every codec of a byte stream, for any bytes.
#pragma once

#include "firmware_host/tracker/device_frame.h"
#include "firmware_host/tracker/stream_buffer.h"
#include "tests/fuzz/fuzz.h"

#include <algorithm>
#include <array>
#include <bit>
#include <variant>
#include <vector>

namespace frustumscreen::fuzz {

inline void require_sound(const tracker::DeviceFrame& frame) {
    require(frame.count <= tracker::DeviceFrame::max_sensors,
            "a frame has no more sensors than it has room for");
    for (std::size_t k = 0; k < frame.count; ++k) {
        const tracker::SensorPose& pose = frame.sensors[k];
        require(pose.sensor >= 1 && pose.sensor <= 128, "a sensor is numbered from 1");
        require(pose.distortion >= 0 && pose.distortion <= 255, "a distortion is a byte");
        require(!pose.usable ||
                    (is_finite(pose.position_m) && tracker::is_pose(pose.position_m, pose.rotation)),
                "a usable pose is finite, near and a rotation");
    }
}

/// Compares a whole frame; NaN equals NaN.
inline bool same_bits(const tracker::DeviceFrame& a, const tracker::DeviceFrame& b) {
    const auto bits = [](const tracker::SensorPose& p) {
        return std::bit_cast<std::array<std::uint64_t, 7>>(
            std::array{p.position_m.x, p.position_m.y, p.position_m.z, p.rotation.w, p.rotation.x,
                       p.rotation.y, p.rotation.z});
    };
    bool same =
        a.counter == b.counter && a.tick == b.tick && a.count == b.count && a.units_as_set == b.units_as_set;
    for (std::size_t k = 0; same && k < a.count; ++k) {
        const tracker::SensorPose& p = a.sensors[k];
        const tracker::SensorPose& q = b.sensors[k];
        same = p.sensor == q.sensor && p.distortion == q.distortion && p.usable == q.usable &&
               bits(p) == bits(q);
    }
    return same;
}

/// Takes every frame that `parse` finds in the received bytes; skips refused bytes.
template <typename Parse>
void take_frames(tracker::StreamBuffer& stream, Parse parse, std::vector<tracker::DeviceFrame>& frames) {
    while (true) {
        const std::size_t size = stream.bytes().size();
        const auto step = parse(stream.bytes());
        require(step.consumed <= size, "a codec uses no more bytes than there are");
        require((step.consumed == 0) == (step.message.index() == 0),
                "nothing is used only while more is needed");
        if (step.consumed == 0) {
            return;
        }
        if (const auto* frame = std::get_if<tracker::DeviceFrame>(&step.message)) {
            require_sound(*frame);
            frames.push_back(*frame);
        }
        stream.drop(step.consumed);
    }
}

/// Bytes that arrive one by one give the same frames as bytes that arrive together.
template <typename Parse> void check_stream(std::span<const std::byte> bytes, Parse parse) {
    tracker::StreamBuffer stream;
    std::vector<tracker::DeviceFrame> together;
    for (std::span<const std::byte> rest = bytes; !rest.empty();) {
        const std::size_t taken = stream.append(rest);
        require(taken > 0, "no frame is longer than the buffer");
        rest = rest.subspan(taken);
        take_frames(stream, parse, together);
    }
    stream.clear();
    std::vector<tracker::DeviceFrame> one_by_one;
    for (std::size_t k = 0; k < bytes.size(); ++k) {
        static_cast<void>(stream.append(bytes.subspan(k, 1)));
        take_frames(stream, parse, one_by_one);
    }
    require(std::equal(together.begin(), together.end(), one_by_one.begin(), one_by_one.end(), same_bits),
            "frames do not depend on how the bytes were cut");
}

} // namespace frustumscreen::fuzz
