/// A kiosk's life under a policy: what was shown, which steps were taken, which of them needlessly.
///
/// Policies the ladder; systemd's restart and watchdog alone; a reboot at every fault that the same judge
/// detects, at least two minutes apart. All face identical faults, nights and load.
/// False    a step is a false alarm if nothing was wrong for a minute before it and an exhibit was shown; a
///          return after ten good minutes is none.
/// Threads  pure; any.
#pragma once

#include "app/watch/ladder.h"
#include "tests/simulators/museum/fault_kinds.h"
#include "tests/simulators/museum/kiosk_model.h"

#include <array>
#include <span>
#include <string_view>
#include <vector>

namespace frustumscreen::simulators {

enum class Policy : std::uint8_t { Ladder, SystemdAlone, RebootAtEveryTrouble };
inline constexpr std::array all_policies{Policy::Ladder, Policy::SystemdAlone, Policy::RebootAtEveryTrouble};
[[nodiscard]] std::string_view name_of(Policy policy);

/// The museum is open from ten to six; the exhibit sleeps from eight in the evening to eight in the morning,
/// which does not count as dark. At ten and at two, under every policy, staff look at it and power-cycle it
/// if it shows no exhibit or does not follow the prop.
inline constexpr MuseumTime opens_s = 10 * 3600, closes_s = 18 * 3600;
inline constexpr MuseumTime second_round_s = 14 * 3600;
inline constexpr MuseumTime sleeps_s = 20 * 3600, wakes_s = 8 * 3600;

struct TakenStep {
    MuseumTime at = 0;
    watch::LadderAction act;
    bool is_false_alarm = false;
};
struct MuseumRun {
    Policy policy = Policy::Ladder;
    std::array<MuseumTime, visible_state_count> open{}; ///< seconds of opening hours
    MuseumTime longest_dark_s = 0;                      ///< by day or night, without interruption
    MuseumTime longest_dark_at = 0;
    std::array<MuseumTime, fault_kind_count> longest{}; ///< longest dark period that began with this fault
    std::vector<MuseumTime> dark_times;                 ///< seconds of each dark period
    std::vector<TakenStep> steps;
    std::size_t max_reboots_in_day = 0;
};

[[nodiscard]] MuseumRun simulate(Policy policy, std::span<const FaultEvent> fault_events, int days,
                                 std::uint64_t seed);

} // namespace frustumscreen::simulators
