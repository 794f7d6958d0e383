/// `frustumscreen-bench counts`: what a frame takes, in numbers that do not depend on the machine.
#pragma once

#include "app/programs/bench/bench_command.h"

namespace frustumscreen {

[[nodiscard]] BenchCommand counts_command(CLI::App& app);

} // namespace frustumscreen
