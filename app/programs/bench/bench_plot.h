/// `frustumscreen-bench plot`: the results of several artifacts on one sheet.
#pragma once

#include "app/programs/bench/bench_command.h"

namespace frustumscreen {

[[nodiscard]] BenchCommand plot_command(CLI::App& app);

} // namespace frustumscreen
