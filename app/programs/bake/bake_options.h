/// The options that control how an artifact is baked, shared by a single bake, --watch and --batch.
///
/// Threads  any.
#pragma once

#include "app/programs/bake/bake_request.h"
#include "app/programs/common/command_line.h"

#include <string>
#include <vector>

namespace frustumscreen::programs {

void add_bake_options(CommandLine& app, BakeArguments& arguments);

/// The given options as command-line words; options that were not given are left out.
[[nodiscard]] std::vector<std::string> bake_options_of(const BakeArguments& arguments);

} // namespace frustumscreen::programs
