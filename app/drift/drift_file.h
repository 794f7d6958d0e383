/// The name of the file of a drift's reference (drift_reference.h), in the folder of the kept calibrations.
#pragma once

namespace frustumscreen {

inline constexpr const char* drift_file = "drift.json";

} // namespace frustumscreen
