/// One bake from the request to the pack on the disk.
///
/// Errors   one sentence; nothing is written then.
/// Threads  one caller; uses all cores. Says on standard error what is lost, and how far it is.
#pragma once

#include "app/programs/bake/bake_report.h"
#include "app/programs/bake/bake_request.h"

namespace frustumscreen {

[[nodiscard]] Result<BakeResult> bake_pack(const BakeRequest& request);

} // namespace frustumscreen
