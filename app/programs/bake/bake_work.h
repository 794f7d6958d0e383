/// Runs one bake, from the request to the pack on the disk.
///
/// Errors   one sentence; then nothing is written.
/// Threads  one caller; uses all cores. Writes losses and progress to standard error.
#pragma once

#include "app/programs/bake/bake_report.h"
#include "app/programs/bake/bake_request.h"

namespace frustumscreen::programs {

[[nodiscard]] Result<BakeResult> bake_pack(const BakeRequest& request);

} // namespace frustumscreen::programs
