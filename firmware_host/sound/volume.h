/// The exhibit's volume over the day.
///
/// Units    decibels, hours of the local day.
/// Threads  pure; any.
#pragma once

#include <vector>

namespace frustumscreen::sound {

struct VolumeHour {
    double from_h = 0.0;  ///< 0 <= from_h < 24
    double gain_db = 0.0; ///< added to the volume's own, until the next row's hour
};

struct Volume {
    /// A change at an hour is a slow ramp from that hour on, too slow to be noticed.
    static constexpr double ramp_h = 0.25;

    double gain_db = 0.0;
    std::vector<VolumeHour>
        hours; ///< ascending; the last row lasts over midnight until the first. None: always 0 dB
};

/// Continuous in time, also over midnight.
[[nodiscard]] double gain_db_at(const Volume& volume, double hour_of_day);

} // namespace frustumscreen::sound
