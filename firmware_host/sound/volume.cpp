#include "firmware_host/sound/volume.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::sound {

namespace {

constexpr double hours_a_day = 24.0;

/// Hours from `from` forward to `to`, across midnight if necessary.
double hours_between(double from, double to) {
    const double hours = std::fmod(to - from, hours_a_day);
    return hours < 0.0 ? hours + hours_a_day : hours;
}

} // namespace

double gain_db_at(const Volume& volume, double hour_of_day) {
    const std::vector<VolumeHour>& rows = volume.hours;
    if (rows.size() < 2) {
        return volume.gain_db + (rows.empty() ? 0.0 : rows.front().gain_db);
    }
    const double hour = hours_between(0.0, hour_of_day);
    const auto after = std::upper_bound(rows.begin(), rows.end(), hour,
                                        [](double h, const VolumeHour& row) { return h < row.from_h; });
    const std::size_t next = static_cast<std::size_t>(after - rows.begin()) % rows.size();
    const VolumeHour& now = rows[(next + rows.size() - 1) % rows.size()];
    const VolumeHour& before = rows[(next + rows.size() - 2) % rows.size()];
    const double ramp_h = std::min(Volume::ramp_h, hours_between(now.from_h, rows[next].from_h));
    const double share = std::min(hours_between(now.from_h, hour) / ramp_h, 1.0);
    return volume.gain_db + before.gain_db + (now.gain_db - before.gain_db) * share;
}

} // namespace frustumscreen::sound
