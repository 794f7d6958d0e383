/// The next seven days' hours, as the settings have them.
///
/// Time     `now`, and the local time then.
/// Threads  pure; any.
#pragma once

#include "app/exhibit/hours.h"

#include <chrono>
#include <string>

namespace frustumscreen {

/// One line for each day, and one for what comes next.
[[nodiscard]] std::string week_page(const HoursSettings& hours, std::chrono::sys_seconds now,
                                    const OffsetAt& offset_at);

} // namespace frustumscreen
