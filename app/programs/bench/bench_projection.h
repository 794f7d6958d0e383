/// `frustumscreen-bench projection`: the visitor's view against an ordinary ray cast.
#pragma once

#include "app/programs/bench/bench_command.h"

namespace frustumscreen {

[[nodiscard]] BenchCommand projection_command(CLI::App& app);

} // namespace frustumscreen
