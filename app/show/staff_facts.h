/// What the staff's pages say beside what was pressed: the status, the calibration in use, devices, volume.
///
/// Units    decibels.
/// Threads  pure; any.
/// Errors   none: what nobody says is left out.
#pragma once

#include "app/exhibit/states.h"
#include "app/settings/settings.h"
#include "app/show/run_report.h"
#include "app/tracking/signal_meter.h"

#include <cstddef>
#include <ctime>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// What the pages say beside what was pressed; sentences that are empty are left out.
struct StaffFacts {
    std::vector<std::string> lines; ///< of the status
    std::string card;               ///< for the QR code
    std::string calibration;        ///< that is in use
    std::string drift;
    std::string tracker, camera, panel, sound;
    TrackerSignal prop, head;
    double settings_gain_db = 0.0; ///< the volume of this hour
    std::size_t buttons = 2;       ///< of the panel
    bool tracks_head = false;
    bool calibrates = false; ///< the staff may begin the table's calibration
    bool speaks = false;     ///< there is something to be heard with

    [[nodiscard]] bool operator==(const StaffFacts&) const = default;
};

/// Of what the status says. `driver`: the display's name for itself. `before`: the state before the picture came. `now`: the wall clock.
[[nodiscard]] StaffFacts staff_facts(const RunStatus& status, const Settings& settings,
                                     std::string_view driver, State before, std::time_t now);
/// Which calibration is used, how old it is, and how good.
[[nodiscard]] std::string calibration_line(const CalibrationSettings& settings, std::time_t now);

} // namespace frustumscreen
