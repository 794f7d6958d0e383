/// The project's version, as CMake has it: a new version compiles one file.
///
/// Threads  pure; any.
#pragma once

#include <string>
#include <string_view>

namespace frustumscreen {

/// Three numbers: `0.9.0`.
[[nodiscard]] std::string_view project_version();

/// The output of `--version`: `frustumscreen-bake 0.9.0`.
[[nodiscard]] std::string name_and_version(std::string_view program);

} // namespace frustumscreen
