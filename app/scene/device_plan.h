/// The devices that an exhibit opens, decided before it opens any: a pure function of the settings. No other
/// device is opened and no other thread is started.
///
/// Threads  pure; any.
#pragma once

#include "app/settings/settings.h"

#include <string>
#include <vector>

namespace frustumscreen::scene {

/// The exhibit's devices and threads.
struct DevicePlan {
    settings::TrackerKind tracker = settings::TrackerKind::None;
    bool head = false;    ///< the tracker's head samples are used
    bool tags = false;    ///< a camera follows the prop's tags
    bool visitor = false; ///< a camera sees who stands at the table
    bool drift = false;   ///< a camera checks that the picture has not drifted since calibration
    settings::TorchSource torch = settings::TorchSource::None;
    bool screen = false;      ///< there is a screen behind the table
    bool panel = false;       ///< there are buttons
    bool other_packs = false; ///< a button or the table leads to artifacts other than the first
    bool language = false;    ///< a button leads to another language
    std::vector<std::string> threads;
    std::vector<std::string> left_out; ///< sentences
};
/// `pressed`: another source than the panel presses "next artifact". `status_file`: a status file is written.
[[nodiscard]] DevicePlan plan_devices(const settings::Settings& settings, bool pressed, bool status_file);

} // namespace frustumscreen::scene
