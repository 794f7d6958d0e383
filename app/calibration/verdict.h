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

} // namespace frustumscreen
