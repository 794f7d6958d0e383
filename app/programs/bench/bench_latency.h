/// `frustumscreen-bench latency`: how far the picture slips on a prop that moves, with and without
/// prediction.
#pragma once

#include "app/programs/bench/bench_command.h"

namespace frustumscreen {

[[nodiscard]] BenchCommand latency_command(CLI::App& app);

} // namespace frustumscreen
