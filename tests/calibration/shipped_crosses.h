/// The crosses of the shipped set-up (config/kiosk.toml), and the crosses for a prop that may hang over the
/// table's edge.
#pragma once

#include "app/calibration/choose_crosses.h"
#include "tests/calibration/simulated_touches.h"

namespace frustumscreen::calibration {

inline constexpr double shipped_top_m = 0.155;
inline constexpr double shipped_base_m = 0.30;
inline constexpr int shipped_touches = 15;

[[nodiscard]] inline TouchModel shipped_model() {
    return rough_model({1920, 1200, 3600.0, 3600.0, 960.0, 600.0}, 1.5, 0.085);
}

[[nodiscard]] inline CrossSetup shipped_cross_setup(int count) {
    CrossSetup setup;
    setup.count = count;
    setup.top_m = shipped_top_m;
    setup.reach_m = reach_of({0.8, 0.5}, shipped_base_m);
    return setup;
}

/// A process chooses each number once.
[[nodiscard]] inline const std::vector<Cross>& shipped_crosses(int count) {
    static std::map<int, std::vector<Cross>> chosen;
    std::vector<Cross>& crosses = chosen[count];
    if (crosses.empty()) {
        crosses = choose_crosses(shipped_model(), shipped_cross_setup(count));
    }
    return crosses;
}

[[nodiscard]] inline std::vector<Cross> crosses_all_over(int count) {
    CrossSetup setup = shipped_cross_setup(count);
    setup.reach_m.reset();
    return choose_crosses(shipped_model(), setup);
}

} // namespace frustumscreen::calibration
