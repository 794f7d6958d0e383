/// The verdict on a calibration, for a technician.
///
/// Threads  values; any.
#pragma once

#include "firmware_host/base/result.h"

#include <string>
#include <string_view>

namespace frustumscreen::calibration {

enum class Verdict {
    Good,    ///< as accurate as possible
    Usable,  ///< visitors will hardly notice the remaining error
    Repeat,  ///< some points must be repeated, or more are needed
    Refused, ///< the points determine nothing; the reason says why
};
[[nodiscard]] std::string_view name_of(Verdict verdict);

/// Why a calibration has its verdict.
struct VerdictReason {
    MessageId id = "verdict.none"; ///< stays when the wording changes; docs/verdicts.md lists all of them
    std::string sentence;          ///< one sentence
};

} // namespace frustumscreen::calibration
