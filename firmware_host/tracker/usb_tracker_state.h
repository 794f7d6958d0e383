/// The state of a USB tracker, and its sentence for the person next to the device.
///
/// Threads  values.
#pragma once

#include "firmware_host/base/device_state.h"
#include "firmware_host/tracker/tracker.h"

#include <string_view>

namespace frustumscreen::tracker {

enum class UsbTrackerState {
    NotConnected,
    NoPermission,
    FirmwareNotLoaded,
    InUse,
    UsbFailed,
    CannotBeOpened,
    SettingUp,
    Booting,
    WrongUnits,
    SetUpRefused,
    Silent,
    DeviceFault,
    Streaming,
    FilterStaysOn,
    SetUpDoubtful,
    SensorMissing,
    PosesUnusable,
    PosesLate,
    MetalNear,
};

/// One plain sentence, and its id.
[[nodiscard]] constexpr DeviceNote note_of(UsbTrackerState state) {
    switch (state) {
    case UsbTrackerState::NotConnected:
        return {"tracker.not_connected", "no tracker is connected; check its USB cable and its power"};
    case UsbTrackerState::NoPermission:
        return {"tracker.no_permission",
                "a tracker is connected, but this user may not open it; install the udev rules that come "
                "with FrustumScreen"};
    case UsbTrackerState::FirmwareNotLoaded:
        return {
            "tracker.firmware_not_loaded",
            "the tracker is connected, but its firmware is not loaded; load it with Polhemus' own loader"};
    case UsbTrackerState::InUse:
        return {"tracker.in_use", "the tracker is in use by another program; end that program"};
    case UsbTrackerState::UsbFailed:
        return {"tracker.usb_unusable",
                "USB cannot be used on this machine; check that /dev/bus/usb is there"};
    case UsbTrackerState::CannotBeOpened:
        return {"tracker.cannot_be_opened",
                "a tracker is connected, but cannot be opened over USB; pull its cable, and try another port "
                "and another cable"};
    case UsbTrackerState::SettingUp:
        return {"tracker.setting_up", "the tracker is being set up"};
    case UsbTrackerState::Booting:
        return {"tracker.booting", "the tracker is still booting; wait"};
    case UsbTrackerState::WrongUnits:
        return {"tracker.wrong_units",
                "the tracker does not keep metric units; switch it off and on, and update its firmware if it "
                "stays so"};
    case UsbTrackerState::SetUpRefused:
        return {"tracker.set_up_refused",
                "the tracker refuses its set-up or does not answer; switch it off and on"};
    case UsbTrackerState::Silent:
        return {"tracker.silent", "the tracker has stopped sending; if it stays so, switch it off and on"};
    case UsbTrackerState::DeviceFault:
        return {"tracker.device_fault", "the tracker reports a fault of its own; switch it off and on"};
    case UsbTrackerState::Streaming:
        return {"tracker.streaming", "the tracker is running"};
    case UsbTrackerState::FilterStaysOn:
        return {"tracker.filter_stays_on",
                "the tracker runs, but its own filter cannot be switched off and the picture may lag; switch "
                "it off and on, and update its firmware if it stays so"};
    case UsbTrackerState::SetUpDoubtful:
        return {"tracker.set_up_doubtful",
                "the tracker runs, but warned while it was set up, or does not say how it is set; if the "
                "picture is wrong, switch it off and on, and update its firmware"};
    case UsbTrackerState::SensorMissing:
        return {"tracker.sensor_missing",
                "the tracker runs, but the prop's sensor is missing; plug it into connector 1"};
    case UsbTrackerState::PosesUnusable:
        return {"tracker.poses_unusable",
                "the tracker sends no pose of the prop that can be used; switch it off and on, and look at "
                "the sensor's cable if it stays so"};
    case UsbTrackerState::PosesLate:
        return {
            "tracker.poses_late",
            "the tracker runs, but its poses come late, or at another rate than it reports; switch it off "
            "and on, and try another port if it stays so"};
    case UsbTrackerState::MetalNear:
        return {"tracker.metal_near",
                "the tracker's field is distorted; take metal away from its source and sensors"};
    }
    return {"tracker.unknown", ""};
}
/// One plain sentence: the state, and what to do about it. Streaming has a sentence too.
[[nodiscard]] constexpr std::string_view sentence_of(UsbTrackerState state) {
    return note_of(state).sentence;
}

[[nodiscard]] constexpr TrackerHealth health_of(UsbTrackerState state) {
    switch (state) {
    case UsbTrackerState::Streaming:
    case UsbTrackerState::FilterStaysOn:
    case UsbTrackerState::SetUpDoubtful:
    case UsbTrackerState::PosesUnusable:
    case UsbTrackerState::PosesLate:
        return TrackerHealth::Well;
    case UsbTrackerState::MetalNear:
        return TrackerHealth::MetalNear;
    default:
        return TrackerHealth::Away;
    }
}

[[nodiscard]] constexpr DeviceCondition condition_of(UsbTrackerState state) {
    if (state == UsbTrackerState::Streaming) {
        return {DeviceHealth::Well, note_of(state).id};
    }
    const bool is_away = health_of(state) == TrackerHealth::Away;
    return {is_away ? DeviceHealth::Away : DeviceHealth::Impaired, note_of(state).id};
}

/// Whether the device is plugged in but does not work, so that a reset of its port may help.
[[nodiscard]] constexpr bool hangs(UsbTrackerState state) {
    return state == UsbTrackerState::CannotBeOpened || state == UsbTrackerState::SetUpRefused ||
           state == UsbTrackerState::Silent || state == UsbTrackerState::DeviceFault;
}

} // namespace frustumscreen::tracker
