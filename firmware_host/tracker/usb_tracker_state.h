/// The state of a USB tracker, and its sentence for the person next to the device.
///
/// Threads  values.
#pragma once

#include "firmware_host/tracker/tracker.h"

#include <string_view>

namespace frustumscreen {

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

/// One plain sentence: the state, and what to do about it.
[[nodiscard]] constexpr std::string_view sentence_of(UsbTrackerState state) {
    switch (state) {
    case UsbTrackerState::NotConnected:
        return "no tracker is connected; check its USB cable and its power";
    case UsbTrackerState::NoPermission:
        return "a tracker is connected, but this user may not open it; install the udev rules that come "
               "with FrustumScreen";
    case UsbTrackerState::FirmwareNotLoaded:
        return "the tracker is connected, but its firmware is not loaded; load it with Polhemus' own loader";
    case UsbTrackerState::InUse:
        return "the tracker is in use by another program; end that program";
    case UsbTrackerState::UsbFailed:
        return "USB cannot be used on this machine; check that /dev/bus/usb is there";
    case UsbTrackerState::CannotBeOpened:
        return "a tracker is connected, but cannot be opened over USB; pull its cable, and try another port "
               "and another cable";
    case UsbTrackerState::SettingUp:
        return "the tracker is being set up";
    case UsbTrackerState::Booting:
        return "the tracker is still booting; wait";
    case UsbTrackerState::WrongUnits:
        return "the tracker does not keep metric units; switch it off and on, and update its firmware if it "
               "stays so";
    case UsbTrackerState::SetUpRefused:
        return "the tracker refuses its set-up or does not answer; switch it off and on";
    case UsbTrackerState::Silent:
        return "the tracker has stopped sending; if it stays so, switch it off and on";
    case UsbTrackerState::DeviceFault:
        return "the tracker reports a fault of its own; switch it off and on";
    case UsbTrackerState::Streaming:
        return "the tracker is running";
    case UsbTrackerState::FilterStaysOn:
        return "the tracker runs, but its own filter cannot be switched off and the picture may lag; switch "
               "it off and on, and update its firmware if it stays so";
    case UsbTrackerState::SetUpDoubtful:
        return "the tracker runs, but warned while it was set up, or does not say how it is set; if the "
               "picture is wrong, switch it off and on, and update its firmware";
    case UsbTrackerState::SensorMissing:
        return "the tracker runs, but the prop's sensor is missing; plug it into connector 1";
    case UsbTrackerState::PosesUnusable:
        return "the tracker sends no pose of the prop that can be used; switch it off and on, and look at "
               "the sensor's cable if it stays so";
    case UsbTrackerState::PosesLate:
        return "the tracker runs, but its poses come late, or at another pace than it says; switch it off "
               "and on, and try another port if it stays so";
    case UsbTrackerState::MetalNear:
        return "the tracker's field is distorted; take metal away from its source and sensors";
    }
    return "";
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

/// The device is plugged in, may be opened, and does not work: a reset of its port may help.
[[nodiscard]] constexpr bool hangs(UsbTrackerState state) {
    return state == UsbTrackerState::CannotBeOpened || state == UsbTrackerState::SetUpRefused ||
           state == UsbTrackerState::Silent || state == UsbTrackerState::DeviceFault;
}

} // namespace frustumscreen
