/// The requested settings of a camera, and the resulting ones.
///
/// Threads  values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::camera {

/// In order of preference: the formats that are cheapest to decode come first.
enum class PixelFormat : std::uint8_t { Grey, Yuyv, Mjpeg };

[[nodiscard]] constexpr std::string_view name_of(PixelFormat format) {
    return format == PixelFormat::Grey ? "GREY" : format == PixelFormat::Yuyv ? "YUYV" : "MJPEG";
}

struct CameraMode {
    PixelFormat format = PixelFormat::Grey;
    int width = 0, height = 0;
    double rate_hz = 0.0; ///< 0: not reported by the driver
    [[nodiscard]] bool operator==(const CameraMode&) const = default;
};

struct CameraRequest {
    std::string device = "any"; ///< "any", a path, or the camera's name
    int width = 1280, height = 720;
    double rate_hz = 30.0;
    /// nullopt: keep the camera's own value, but lock it.
    std::optional<double> exposure_ms;
    std::optional<int> gain;            ///< in the camera's own steps
    std::optional<int> white_balance_k; ///< kelvin
};

enum class Lock : std::uint8_t {
    Locked,   ///< read back as requested; the driver may answer from memory
    Changed,  ///< locked, but at another value than requested
    Refused,  ///< the camera continues to change it, or does not report it
    NotThere, ///< the camera has no such control
};

[[nodiscard]] constexpr std::string_view name_of(Lock lock) {
    switch (lock) {
    case Lock::Locked:
        return "locked";
    case Lock::Changed:
        return "locked at another value";
    case Lock::Refused:
        return "not locked";
    case Lock::NotThere:
        return "no such control";
    }
    return "";
}

struct LockedControl {
    std::string_view name; ///< "exposure", "gain", "white balance"
    std::string_view unit; ///< "ms", "", "K"
    Lock lock = Lock::NotThere;
    double value = 0.0; ///< as read back
};

struct CameraSetUp {
    std::string path; ///< /dev/video0
    std::string name; ///< name reported by the camera
    std::string bus;  ///< port that it is plugged into
    CameraMode mode;  ///< as accepted by the driver
    std::vector<LockedControl> controls;
};

} // namespace frustumscreen::camera
