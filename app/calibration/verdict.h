/// What a technician is told of a calibration.
///
/// Threads  values; any.
#pragma once

#include <string_view>

namespace frustumscreen {

enum class Verdict {
    Good,    ///< as well as it gets
    Usable,  ///< visitors will hardly notice what is left
    Repeat,  ///< not yet: some points are to be done again, or more of them
    Refused, ///< these points say nothing; the reason says why
};
[[nodiscard]] std::string_view name_of(Verdict verdict);

/// What a verdict promises (docs/calibration.md): standard deviations of the picture, and what a wrong point could hide.
struct VerdictLimits {
    double mean_m;
    double worst_m;
    double hidden_m;
};
inline constexpr VerdictLimits for_good{0.7e-3, 1.4e-3, 16e-3};
inline constexpr VerdictLimits for_usable{1.2e-3, 2.5e-3, 40e-3};

} // namespace frustumscreen
