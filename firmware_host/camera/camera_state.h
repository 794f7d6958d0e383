/// The state of a camera, and its sentence for the person next to the device.
///
/// Threads  values.
#pragma once

#include "firmware_host/base/device_state.h"

#include <cstdint>
#include <string_view>

namespace frustumscreen::camera {

enum class CameraState : std::uint8_t {
    NotConnected,
    NoPermission,
    InUse,
    CannotBeOpened,
    NoFormat,
    SetUpRefused,
    SettingUp,
    Running,
    Unlocked,
    Slow,
    Dark,
    Blinded,
    Frozen,
    Broken,
    Silent,
};

/// One plain sentence, and its id.
[[nodiscard]] constexpr DeviceNote note_of(CameraState state) {
    switch (state) {
    case CameraState::NotConnected:
        return {"camera.not_connected",
                "no camera is connected; check its USB cable, and its name in the settings"};
    case CameraState::NoPermission:
        return {"camera.no_permission",
                "a camera is connected, but this user may not open it; put the user into the group video"};
    case CameraState::InUse:
        return {"camera.in_use", "the camera is in use by another program; end that program"};
    case CameraState::CannotBeOpened:
        return {"camera.cannot_be_opened",
                "a camera is connected, but cannot be opened; pull its cable, and try another port and "
                "another "
                "cable"};
    case CameraState::NoFormat:
        return {"camera.no_format",
                "the camera sends no format that can be read (GREY, YUYV, MJPEG); use another camera"};
    case CameraState::SetUpRefused:
        return {"camera.set_up_refused",
                "the camera refuses its set-up or does not answer; pull its cable and put it back"};
    case CameraState::SettingUp:
        return {"camera.setting_up", "the camera is being set up"};
    case CameraState::Running:
        return {"camera.running", "the camera is running"};
    case CameraState::Unlocked:
        return {"camera.unlocked",
                "the camera runs, but its exposure or its white balance cannot be locked, so its picture may "
                "change by itself; use another camera if that disturbs visitors"};
    case CameraState::Slow:
        return {
            "camera.slow",
            "the camera sends less than half of its frames; try another USB port, and nothing else at its "
            "hub"};
    case CameraState::Dark:
        return {"camera.dark", "the camera sees only darkness; uncover it, or light the room"};
    case CameraState::Blinded:
        return {"camera.blinded",
                "the camera is blinded; take away the light that shines into it, or shorten its exposure in "
                "the "
                "settings"};
    case CameraState::Frozen:
        return {"camera.frozen",
                "the camera sends the same picture again and again; pull its cable and put it back"};
    case CameraState::Broken:
        return {"camera.broken", "the camera's frames are damaged; try another USB cable and another port"};
    case CameraState::Silent:
        return {"camera.silent",
                "the camera has stopped sending; if it stays so, pull its cable and put it back"};
    }
    return {"camera.unknown", ""};
}
/// One plain sentence: the state, and what to do about it. Running has a sentence too.
[[nodiscard]] constexpr std::string_view sentence_of(CameraState state) {
    return note_of(state).sentence;
}

/// How usable a camera is.
enum class CameraHealth : std::uint8_t {
    Well,
    Impaired, ///< frames come, but too few, or they show nothing
    Away,     ///< no frames come
};

[[nodiscard]] constexpr CameraHealth health_of(CameraState state) {
    switch (state) {
    case CameraState::Running:
    case CameraState::Unlocked:
        return CameraHealth::Well;
    case CameraState::Slow:
    case CameraState::Dark:
    case CameraState::Blinded:
    case CameraState::Frozen:
        return CameraHealth::Impaired;
    default:
        return CameraHealth::Away;
    }
}

/// Unlocked counts as Well: a camera without locks cannot be given any.
[[nodiscard]] constexpr DeviceCondition condition_of(CameraState state) {
    const CameraHealth health = health_of(state);
    return {health == CameraHealth::Well       ? DeviceHealth::Well
            : health == CameraHealth::Impaired ? DeviceHealth::Impaired
                                               : DeviceHealth::Away,
            note_of(state).id};
}

/// Whether its frames show what is in front of it now, even if they come slowly or are too bright.
[[nodiscard]] constexpr bool shows_something(CameraState state) {
    return health_of(state) == CameraHealth::Well || state == CameraState::Slow ||
           state == CameraState::Blinded;
}

[[nodiscard]] constexpr std::string_view name_of(CameraHealth health) {
    return health == CameraHealth::Well ? "well" : health == CameraHealth::Impaired ? "impaired" : "away";
}

} // namespace frustumscreen::camera
