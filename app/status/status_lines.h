/// The exhibit's state, in lines that a technician can read out on the telephone.
///
/// Threads  pure; any.
/// Errors   none: what is unknown has no line, or its line says so.
#pragma once

#include "app/status/known_exhibit.h"
#include "app/status/status_report.h"

#include <ctime>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::status {

struct StatusLine {
    std::string name; ///< such as 'tracker'
    std::string text;
    bool for_staff = true; ///< the staff's picture shows it too
};
/// `status`: null: unknown. `age_s`: of the status; none: it is out of date. `environment`: null: not asked yet.
/// `now`: the wall clock, used for times of day alone.
[[nodiscard]] std::vector<StatusLine> status_lines(const StatusReport* status, std::optional<double> age_s,
                                                   const Environment* environment, std::time_t now);

/// One screen of text: the verdict, then the lines.
[[nodiscard]] std::string status_text(const KnownExhibit& known, std::time_t now);

} // namespace frustumscreen::status
