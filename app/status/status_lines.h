/// What is known of the exhibit, in lines that a technician can read aloud on the telephone.
///
/// Threads  pure; any.
/// Errors   none: what nobody says has no line, or says so.
#pragma once

#include "app/status/known_exhibit.h"
#include "app/status/status_report.h"

#include <ctime>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen {

struct StatusLine {
    std::string name; ///< as 'tracker'
    std::string text;
    bool for_staff = true; ///< the staff's picture has it too
};
/// `status`: none: nothing is known. `age_s`: of the status; none: it is not of now. `surroundings`: none: nobody has asked yet. `now`: the wall clock, for times of day alone.
[[nodiscard]] std::vector<StatusLine> status_lines(const StatusReport* status, std::optional<double> age_s,
                                                   const Surroundings* surroundings, std::time_t now);

/// One screen of text: the verdict, then the lines.
[[nodiscard]] std::string status_text(const KnownExhibit& known, std::time_t now);

} // namespace frustumscreen
