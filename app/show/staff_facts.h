/// The facts on the staff's pages that do not depend on the buttons: status, calibration in use, devices, volume.
///
/// Units    decibels.
/// Threads  pure; any.
/// Errors   none: unknown facts are left out.
#pragma once

#include "app/exhibit/copy_offer.h"
#include "app/exhibit/states.h"
#include "app/settings/settings.h"
#include "app/show/run_report.h"
#include "app/tracking/signal_meter.h"

#include <cstddef>
#include <ctime>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::show {

/// The facts on the pages; empty sentences are left out.
struct StaffFacts {
    std::vector<std::string> lines; ///< of the status
    std::string card;               ///< for the QR code
    std::string calibration;        ///< the one in use
    std::string drift;
    bool stereo = false; ///< each eye has a picture of its own
    bool measures_pixels =
        true; ///< the projector shows the picture in its own pixels, so the table can be measured
    std::string tracker, camera, panel, sound;
    tracking::TrackerSignal prop, head;
    double settings_gain_db = 0.0; ///< the settings' volume for this hour
    std::size_t buttons = 2;       ///< of the panel
    bool tracks_head = false;
    bool calibrates = false; ///< the staff may start the table's calibration
    bool copies = false;     ///< the staff may have a copy of the kiosk written to a stick
    exhibit::CopyState copy; ///< how far that is
    bool speaks = false;     ///< there is a sound device

    [[nodiscard]] bool operator==(const StaffFacts&) const = default;
};

/// The facts from a status. `driver`: the display's name for itself. `before`: the state before the staff picture.
/// `now`: the wall clock.
[[nodiscard]] StaffFacts staff_facts(const RunStatus& status, const settings::Settings& settings,
                                     std::string_view driver, exhibit::State before, std::time_t now);
/// The calibration in use, its age and its quality.
[[nodiscard]] std::string calibration_line(const settings::CalibrationSettings& settings, std::time_t now);

} // namespace frustumscreen::show
