/// `frustumscreen-bench stability`: numerical stability on stiff and extreme cases.
#pragma once

#include "app/programs/bench/bench_command.h"

namespace frustumscreen {

[[nodiscard]] BenchCommand stability_command(CLI::App& app);

} // namespace frustumscreen
