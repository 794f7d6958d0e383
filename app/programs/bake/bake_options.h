/// The options that say how an artifact is baked: one bake, a watched folder and a whole collection take the same.
///
/// Threads  any.
#pragma once

#include "app/programs/bake/bake_request.h"
#include "app/programs/common/command_line.h"

#include <string>
#include <vector>

namespace frustumscreen {

void add_bake_options(CommandLine& app, BakeArguments& arguments);

/// The same options as a command line; those that were left out are not there.
[[nodiscard]] std::vector<std::string> bake_options_of(const BakeArguments& arguments);

} // namespace frustumscreen
