/// The opening hours of the next seven days.
///
/// Time     `now`, in local time.
/// Threads  pure; any.
#pragma once

#include "app/exhibit/hours.h"

#include <chrono>
#include <string>

namespace frustumscreen::programs {

/// One line for each day, and one for the next opening or closing.
[[nodiscard]] std::string week_page(const settings::HoursSettings& hours, std::chrono::sys_seconds now,
                                    const exhibit::OffsetAt& offset_at);

} // namespace frustumscreen::programs
