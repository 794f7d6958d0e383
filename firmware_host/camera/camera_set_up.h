/// What is wished of a camera, and what it was set to in the end.
///
/// Threads  values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// In the order in which they are preferred: the first ones cost least to read.
enum class PixelFormat : std::uint8_t { Grey, Yuyv, Mjpeg };

[[nodiscard]] constexpr std::string_view name_of(PixelFormat format) {
    return format == PixelFormat::Grey ? "GREY" : format == PixelFormat::Yuyv ? "YUYV" : "MJPEG";
}

struct CameraMode {
    PixelFormat format = PixelFormat::Grey;
    int width = 0, height = 0;
    double rate_hz = 0.0; ///< 0: the driver does not say
    [[nodiscard]] bool operator==(const CameraMode&) const = default;
};

struct CameraWish {
    std::string device = "any"; ///< or a path, or the camera's name
    int width = 1280, height = 720;
    double rate_hz = 30.0;
    /// Nothing: the camera's own value, but locked.
    std::optional<double> exposure_ms;
    std::optional<int> gain;            ///< in the camera's own steps
    std::optional<int> white_balance_k; ///< kelvin
};

enum class Lock : std::uint8_t {
    Locked,   ///< read back as it was wished, from the driver, which may answer from memory
    Changed,  ///< locked, but the camera has taken another value than the one wished
    Refused,  ///< the camera goes on changing it, or does not say
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
    std::string name; ///< as the camera calls itself
    std::string bus;  ///< where it is plugged in
    CameraMode mode;  ///< as the driver has taken it
    std::vector<LockedControl> controls;
};

} // namespace frustumscreen
