/// Bytes of the wire formats, written from their descriptions without the codecs, for tests and fake devices.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

namespace frustumscreen::wire {

using Wire = std::vector<std::byte>;

template <typename T> void put(Wire& wire, T value) {
    std::array<std::byte, sizeof(T)> bytes;
    std::memcpy(bytes.data(), &value, sizeof(T));
    wire.insert(wire.end(), bytes.begin(), bytes.end());
}

inline Wire from_hex(std::string_view text) {
    Wire wire;
    unsigned value = 0;
    int digits = 0;
    for (const char c : text) {
        if (c == ' ') {
            continue;
        }
        value = value * 16 + static_cast<unsigned>(c <= '9' ? c - '0' : c - 'A' + 10);
        if (++digits == 2) {
            wire.push_back(static_cast<std::byte>(value));
            value = 0;
            digits = 0;
        }
    }
    return wire;
}

/// CRC-16/ARC by long division, bit by bit.
inline std::uint32_t crc(const Wire& wire) {
    std::uint32_t remainder = 0;
    for (const std::byte byte : wire) {
        for (unsigned bit = 0; bit < 8; ++bit) {
            const bool one = ((remainder ^ (static_cast<unsigned>(byte) >> bit)) & 1U) != 0;
            remainder = one ? (remainder >> 1U) ^ 0xA001U : remainder >> 1U;
        }
    }
    return remainder;
}

struct Pose {
    int connector = 1;
    std::array<float, 3> position{0.25F, -0.5F, 1.0F};
    std::array<float, 4> quaternion{0.5F, 0.5F, -0.5F, 0.5F};
    unsigned distortion = 0;
    unsigned position_units = 3;
    unsigned orientation_units = 2;
};

inline Wire viper_frame(std::uint32_t counter, const std::vector<Pose>& poses, std::uint32_t info = 0) {
    Wire wire;
    put(wire, std::array<char, 4>{'V', 'P', 'R', 'P'});
    put(wire, static_cast<std::uint32_t>(20 + 32 * poses.size()));
    put(wire, std::uint32_t{123456});
    put(wire, counter);
    put(wire, info);
    put(wire, static_cast<std::uint32_t>(poses.size()));
    for (const Pose& pose : poses) {
        put(wire, static_cast<std::uint32_t>(pose.connector - 1) | pose.position_units << 8U |
                      pose.orientation_units << 10U | pose.distortion << 14U);
        put(wire, pose.position);
        put(wire, pose.quaternion);
    }
    put(wire, crc(wire));
    return wire;
}

inline Wire viper_reply(std::uint32_t command, std::uint32_t action, const Wire& payload = {}) {
    Wire wire;
    put(wire, std::array<char, 4>{'V', 'P', 'R', 'C'});
    put(wire, static_cast<std::uint32_t>(24 + payload.size()));
    put(wire, std::uint32_t{123456});
    put(wire, command);
    put(wire, action);
    put(wire, std::uint32_t{0});
    put(wire, std::uint32_t{0});
    wire.insert(wire.end(), payload.begin(), payload.end());
    put(wire, crc(wire));
    return wire;
}

/// Position in centimetres.
inline Wire patriot_frame(std::uint32_t milliseconds, std::uint32_t counter, const Pose& pose,
                          char error = ' ') {
    Wire wire;
    put(wire, std::array<char, 2>{'P', 'A'});
    put(wire, static_cast<std::uint8_t>(pose.connector));
    put(wire, 'C');
    put(wire, error);
    put(wire, '\0');
    put(wire, std::uint16_t{40});
    put(wire, milliseconds);
    put(wire, counter);
    put(wire, static_cast<std::int32_t>(pose.distortion));
    put(wire, pose.position);
    put(wire, pose.quaternion);
    return wire;
}

struct HidPose {
    unsigned station = 1;
    unsigned status = 0;
    unsigned distortion = 0;
    std::uint32_t counter = 1;
    std::uint32_t time_us = 0;
    std::array<std::int32_t, 3> position{25000, -50000, 10000}; ///< in 10 um
    std::array<std::int16_t, 4> quaternion{16384, 16384, -16384, 16384};
};

inline Wire with_crc16(Wire wire) {
    put(wire, static_cast<std::uint16_t>(crc(wire)));
    return wire;
}

inline Wire hid_pose(const HidPose& pose) {
    Wire wire;
    put(wire, std::uint8_t{1});
    put(wire, static_cast<std::uint8_t>(pose.station));
    put(wire, static_cast<std::uint8_t>(pose.status));
    put(wire, static_cast<std::uint8_t>(pose.distortion));
    put(wire, pose.counter);
    put(wire, pose.time_us);
    put(wire, pose.position);
    put(wire, pose.quaternion);
    return with_crc16(std::move(wire));
}

inline Wire hid_info(unsigned unit_um = 10, unsigned version = 1, unsigned rate_hz = 120,
                     unsigned stations = 2) {
    Wire wire;
    put(wire, std::uint8_t{2});
    put(wire, static_cast<std::uint8_t>(version));
    put(wire, static_cast<std::uint16_t>(unit_um));
    put(wire, static_cast<std::uint16_t>(rate_hz));
    put(wire, static_cast<std::uint8_t>(stations));
    put(wire, std::uint8_t{0});
    return with_crc16(std::move(wire));
}

/// Report 1 or 2 of a SpaceMouse; report 1 with both motions if `more` is given.
inline Wire space_mouse(unsigned id, std::array<std::int16_t, 3> axes, const Wire& more = {}) {
    Wire wire;
    put(wire, static_cast<std::uint8_t>(id));
    put(wire, axes);
    wire.insert(wire.end(), more.begin(), more.end());
    return wire;
}

} // namespace frustumscreen::wire
