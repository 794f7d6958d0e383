/// The verdict on a calibration, for a technician.
///
/// Threads  values; any.
#pragma once

#include <string_view>

namespace frustumscreen {

enum class Verdict {
    Good,    ///< as accurate as possible
    Usable,  ///< visitors will hardly notice the remaining error
    Repeat,  ///< some points must be repeated, or more are needed
    Refused, ///< the points determine nothing; the reason says why
};
[[nodiscard]] std::string_view name_of(Verdict verdict);

} // namespace frustumscreen
