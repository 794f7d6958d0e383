/// A kiosk's things for tests: settings, a calibration, days of visits.
#pragma once

#include "app/kiosk_copy/kiosk_copy.h"
#include "app/pack/signature/secret_key.h"
#include "app/settings/calibration.h"

#include <fmt/format.h>

#include <chrono>
#include <string>

namespace frustumscreen::testing_copy {

inline Calibration calibration(int places) {
    Calibration made;
    made.made = "2026-11-25 10:12 UTC";
    made.places = places;
    made.pinhole = {1920, 1200, 3601.25, 3598.5, 955.125, 610.0625};
    made.table_from_projector = {glm::normalize(glm::dquat(0.01, 1.0, 0.002, -0.003)),
                                 {0.1, -0.2, 1.0 / 0.7}};
    made.registration.table_from_tracker = {glm::normalize(glm::dquat(0.3, 0.5, 0.7, -0.5)),
                                            {-0.5, 0.25, -0.125}};
    return made;
}

inline DayCounts day(std::chrono::sys_days day, std::uint64_t visits) {
    DayCounts counts;
    counts.day = day;
    counts.hours[10] = {visits, visits * 60'000};
    counts.artifacts["Amphora"] = counts.hours[10];
    counts.languages["en"] = counts.hours[10];
    return counts;
}

/// Settings that name a key; `more`: further lines.
inline std::string settings_of(const SecretKey& key, const std::string& more = "") {
    return fmt::format("# Anna's\n[exhibit]\nlanguage = \"de\"\n[[exhibit.keys]]\nname = \"Museum\"\n"
                       "public_key = \"{}\"\n{}",
                       public_key_line(key.public_key()), more);
}

inline constexpr std::chrono::sys_days first_day = std::chrono::sys_days(std::chrono::days(20000)); // in 2024

} // namespace frustumscreen::testing_copy
