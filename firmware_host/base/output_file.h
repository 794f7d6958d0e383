/// Checks before the work whether its result can be written, so that neither an hour of work nor an input is
/// lost.
///
/// Errors   one line: the place, what is wrong with it, what to do.
/// Threads  any. Creates and removes an empty file next to the output.
#pragma once

#include "firmware_host/base/result.h"

#include <cstdint>
#include <filesystem>
#include <span>

namespace frustumscreen {

/// Checks that the folder exists, is writable and has `bytes` left, and that `output` is a regular file or
/// does not exist. Removes temporary files that killed runs left of it.
[[nodiscard]] Result<void> check_output_place(const std::filesystem::path& output, std::uintmax_t bytes = 0);

/// Checks that `output` is none of `inputs`, by any name or link.
[[nodiscard]] Result<void> check_output_is_no_input(const std::filesystem::path& output,
                                                    std::span<const std::filesystem::path> inputs);

} // namespace frustumscreen
