/// The numbers of visits as one SVG picture: hours against days, the totals of each hour and each day, and how long
/// each artifact and each language was shown.
///
/// Frame    CSS pixels, origin at the top left; 1200 wide.
/// Threads  pure; any.
#pragma once

#include "app/counts/counts_table.h"

#include <string>
#include <vector>

namespace frustumscreen::counts {

/// `days` is ascending; a missing day has no numbers and stays blank.
[[nodiscard]] std::string counts_plot(const std::vector<DayCounts>& days);

} // namespace frustumscreen::counts
