/// The lines of status_lines.h that the exhibit's own status fills.
///
/// Threads  pure; any.
/// Errors   none.
#pragma once

#include "app/status/line_text.h"
#include "app/status/status_report.h"

#include <ctime>
#include <optional>

namespace frustumscreen::status {

/// `age_s`, `now`: as status_lines.
void add_exhibit(Lines& lines, const StatusReport& status, std::optional<double> age_s, std::time_t now);

} // namespace frustumscreen::status
