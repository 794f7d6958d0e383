/// What error-time wrote, read again: as much of error_time.json as the plots need.
///
/// Threads  pure; any.
/// Errors   bytes that are not such a file, in one line; never a crash.
#pragma once

#include "app/bench/error_plot.h"
#include "firmware_host/base/result.h"

#include <string_view>

namespace frustumscreen {

/// Technique names and kinds, costs, mean and worst errors. Kinds that this version does not know are left
/// out.
[[nodiscard]] Result<ArtifactResults> read_results(std::string_view json);

} // namespace frustumscreen
