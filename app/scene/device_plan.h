/// Which devices an exhibit opens, decided before any is: a pure function of the settings. Nothing outside the plan is opened, and no thread
/// is started but its own.
///
/// Threads  pure; any.
#pragma once

#include "app/settings/settings.h"

#include <string>
#include <vector>

namespace frustumscreen {

/// What the exhibit opens besides its packs.
struct DevicePlan {
    TrackerKind tracker = TrackerKind::None;
    bool head = false;        ///< the tracker's head samples are used
    bool tags = false;        ///< a camera follows the prop's tags
    bool visitor = false;     ///< a camera sees who stands at the table
    bool drift = false;       ///< a camera looks whether the picture lies where it was calibrated
    bool panel = false;       ///< there are buttons
    bool other_packs = false; ///< a button or the table leads to another artifact than the first
    bool language = false;    ///< a button leads to another language
    std::vector<std::string> threads;
    std::vector<std::string> left_out; ///< sentences
};
/// `pressed`: something other than the panel presses 'next artifact'. `status_file`: a status is written.
[[nodiscard]] DevicePlan plan_devices(const Settings& settings, bool pressed, bool status_file);

} // namespace frustumscreen
