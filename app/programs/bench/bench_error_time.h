/// `frustumscreen-bench error-time`: every level of a pack and its peers against a ray cast.
#pragma once

#include "app/programs/bench/bench_command.h"

namespace frustumscreen {

[[nodiscard]] BenchCommand error_time_command(CLI::App& app);

} // namespace frustumscreen
