/// `frustumscreen-bench scaling`: cost against the source's size, built-in amphora.
#pragma once

#include "app/programs/bench/bench_command.h"

namespace frustumscreen {

[[nodiscard]] BenchCommand scaling_command(CLI::App& app);

} // namespace frustumscreen
