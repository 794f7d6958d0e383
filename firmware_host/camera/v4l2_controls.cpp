#include "firmware_host/camera/v4l2_controls.h"

#include <linux/videodev2.h>

#include <cmath>

namespace frustumscreen::camera {

namespace {

/// V4L2 counts exposure in tenths of a millisecond.
constexpr double ticks_per_ms = 10.0;

struct Recipe {
    std::string_view name, unit;
    std::uint32_t automatic; ///< the control that selects automatic mode
    std::int32_t manual;     ///< its value for manual mode
    std::uint32_t value;
    double steps_per_unit;
};
constexpr Recipe exposure{.name = "exposure",
                          .unit = "ms",
                          .automatic = V4L2_CID_EXPOSURE_AUTO,
                          .manual = V4L2_EXPOSURE_MANUAL,
                          .value = V4L2_CID_EXPOSURE_ABSOLUTE,
                          .steps_per_unit = ticks_per_ms};
constexpr Recipe gain{.name = "gain",
                      .unit = "",
                      .automatic = V4L2_CID_AUTOGAIN,
                      .manual = 0,
                      .value = V4L2_CID_GAIN,
                      .steps_per_unit = 1.0};
constexpr Recipe white_balance{.name = "white balance",
                               .unit = "K",
                               .automatic = V4L2_CID_AUTO_WHITE_BALANCE,
                               .manual = 0,
                               .value = V4L2_CID_WHITE_BALANCE_TEMPERATURE,
                               .steps_per_unit = 1.0};

std::optional<std::int32_t> read(V4l2Device& device, std::uint32_t id) {
    v4l2_control control{id, 0};
    return device.ask(VIDIOC_G_CTRL, control) == 0 ? std::optional(control.value) : std::nullopt;
}

bool write(V4l2Device& device, std::uint32_t id, std::int32_t value) {
    v4l2_control control{id, value};
    return device.ask(VIDIOC_S_CTRL, control) == 0;
}

bool is_there(V4l2Device& device, std::uint32_t id) {
    v4l2_queryctrl query{};
    query.id = id;
    return device.ask(VIDIOC_QUERYCTRL, query) == 0 && (query.flags & V4L2_CTRL_FLAG_DISABLED) == 0;
}

LockedControl lock(V4l2Device& device, const Recipe& recipe, std::optional<double> requested) {
    LockedControl locked{.name = recipe.name, .unit = recipe.unit, .lock = Lock::NotThere, .value = 0.0};
    const bool has_automatic = is_there(device, recipe.automatic);
    const bool has_value = is_there(device, recipe.value);
    if (!has_automatic && !has_value) {
        return locked;
    }
    if (has_automatic) {
        static_cast<void>(write(device, recipe.automatic, recipe.manual)); // read back below
    }
    const bool fixed = !has_automatic || read(device, recipe.automatic) == recipe.manual;
    const std::int32_t asked =
        requested ? static_cast<std::int32_t>(std::lround(*requested * recipe.steps_per_unit)) : 0;
    const bool taken = !has_value || !requested || write(device, recipe.value, asked);
    const std::optional<std::int32_t> found =
        has_value ? read(device, recipe.value) : std::optional<std::int32_t>();
    locked.value = found.value_or(0) / recipe.steps_per_unit;
    const bool as_requested = !requested || (taken && found == asked);
    locked.lock = !fixed || (has_value && !found) ? Lock::Refused
                  : as_requested                  ? Lock::Locked
                                                  : Lock::Changed;
    return locked;
}

} // namespace

std::vector<LockedControl> lock_controls(V4l2Device& device, const CameraRequest& request) {
    const auto number = [](const auto& requested) {
        return requested ? std::optional<double>(*requested) : std::optional<double>();
    };
    std::vector<LockedControl> controls{lock(device, exposure, request.exposure_ms),
                                        lock(device, gain, number(request.gain)),
                                        lock(device, white_balance, number(request.white_balance_k))};
    // A camera that may lengthen its exposure in the dark sends fewer frames then.
    static_cast<void>(write(device, V4L2_CID_EXPOSURE_AUTO_PRIORITY, 0));
    return controls;
}

} // namespace frustumscreen::camera
