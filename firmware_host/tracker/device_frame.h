/// A frame of a tracker of any make: its poses at one instant. Codecs produce it; `SequenceChecker` consumes it.
///
/// Frame    tracker K, metres, quaternion w x y z.
/// Threads  values.
#pragma once

#include "firmware_host/tracker/tracker.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace frustumscreen::tracker {

struct SensorPose {
    int sensor = 0; ///< number of the connector, from 1
    glm::dvec3 position_m{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    int distortion = 0;  ///< 0 = an undisturbed field, 255 = the largest value the device reports
    bool usable = false; ///< finite, in range, a rotation, and without a reported fault of this sensor
    bool present = true; ///< false: the device reports that this sensor is not plugged in
};

struct DeviceFrame {
    static constexpr std::size_t max_sensors = 16;

    std::uint32_t counter = 0; ///< counts frames, wraps; reveals lost, repeated and late frames
    std::uint32_t tick = 0;    ///< the device's clock, wraps; in units of the device
    std::array<SensorPose, max_sensors> sensors;
    std::size_t count = 0;    ///< valid entries of `sensors`
    bool units_as_set = true; ///< false: not metres and quaternions; no pose of this frame is usable
    bool fault = false;       ///< the device's self-test failed; the poses may still be good
};

/// Why bytes were discarded.
enum class DiscardReason {
    Garbage,  ///< no frame begins here
    Length,   ///< a header with an impossible size
    Checksum, ///< a whole frame whose CRC is wrong
    Content,  ///< fields that contradict each other
};

/// Whether the rotation has length 1, as nearly as 32-bit numbers and a bent sensor allow, and the position
/// is within a magnetic tracker's reach.
[[nodiscard]] inline bool is_pose(const glm::dvec3& position_m, const glm::dquat& rotation) {
    constexpr double farthest_m = 10.0;
    constexpr double quaternion_tolerance = 0.01;
    const double length = std::sqrt(rotation.w * rotation.w + rotation.x * rotation.x +
                                    rotation.y * rotation.y + rotation.z * rotation.z);
    // Written so that NaN fails.
    return std::abs(length - 1.0) < quaternion_tolerance && std::abs(position_m.x) < farthest_m &&
           std::abs(position_m.y) < farthest_m && std::abs(position_m.z) < farthest_m;
}

} // namespace frustumscreen::tracker
