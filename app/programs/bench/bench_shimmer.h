/// `frustumscreen-bench shimmer`: the prop moved by 0.1 pixel steps, against the ray cast.
#pragma once

#include "app/programs/bench/bench_command.h"

namespace frustumscreen {

[[nodiscard]] BenchCommand shimmer_command(CLI::App& app);

} // namespace frustumscreen
