#include "tests/simulators/museum/fault_kinds.h"

#include <algorithm>
#include <array>
#include <random>

namespace frustumscreen::simulators {

namespace {

constexpr std::array<FaultKindInfo, fault_kind_count> kinds{{
    {"crash", 50.0, ByRestart, 0.0},
    {"hang", 25.0, ByRestart, 0.0},
    {"freeze", 12.0, ByRestart | ByReboot, 0.0},
    {"device_thread", 6.0, ByReset | ByReboot, 0.0},
    {"tracker_hung", 25.0, ByReset | ByReboot, 0.0},
    {"tracker_dead", 1.0, 0, 2.0},
    {"driver_crash", 0.5, ByPlain, 3.0},
    {"gpu_wedged", 6.0, ByReboot | ByPlain, 0.0},
    {"bad_set", 4.0, ByLastGoodSet | ByBuiltIn, 1.0},
    {"bad_settings", 2.0, ByBuiltIn, 1.0},
    {"leak", 2.0, 0, 3.0},
    {"kernel_hang", 4.0, ByReboot, 0.0},
    {"machine_broken", 0.7, 0, 1.5},
    {"power_cut", 12.0, ByReboot, 0.0},
}};
constexpr double days_a_year = 365.25;

} // namespace

const FaultKindInfo& kind_of(FaultKind fault) {
    return kinds.at(static_cast<std::size_t>(fault));
}

std::vector<FaultEvent> seeded_faults(std::uint64_t seed, int days, double times) {
    std::mt19937_64 chance(seed);
    std::vector<FaultEvent> fault_events;
    const double length_s = static_cast<double>(days) * museum_day;
    for (std::size_t k = 0; k < fault_kind_count; ++k) {
        std::exponential_distribution<double> wait(times * kinds[k].rate_per_year /
                                                   (days_a_year * museum_day));
        for (double at = wait(chance); at < length_s; at += wait(chance)) {
            double lasts_s = 0.0;
            if (kinds[k].lasts_days > 0.0) {
                std::exponential_distribution<double> lasts(1.0 / (kinds[k].lasts_days * museum_day));
                lasts_s = 3600.0 + lasts(chance);
            }
            // Faults that need no person are also mended by one in the end, who is called when the table
            // stays dark.
            const double restored_at = at + (kinds[k].lasts_days > 0.0 ? lasts_s : 3.0 * museum_day);
            fault_events.push_back({static_cast<MuseumTime>(at), static_cast<FaultKind>(k),
                                    static_cast<MuseumTime>(restored_at)});
        }
    }
    std::sort(fault_events.begin(), fault_events.end(),
              [](const FaultEvent& a, const FaultEvent& b) { return a.at < b.at; });
    return fault_events;
}

} // namespace frustumscreen::simulators
