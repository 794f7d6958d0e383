/// Looks, before the work, whether its result can be written where a person wants it, so that no hour of work
/// is lost at its end and no input is lost at all.
///
/// Errors   one line: the place, what is wrong with it, what to do.
/// Threads  any. Makes and removes an empty file beside the output.
#pragma once

#include "firmware_host/base/result.h"

#include <cstdint>
#include <filesystem>
#include <span>

namespace frustumscreen {

/// The folder is there and may be written to, and has `bytes` left; `output` itself is a regular file or
/// nothing.
[[nodiscard]] Result<void> check_output_place(const std::filesystem::path& output, std::uintmax_t bytes = 0);

/// `output` is none of `inputs`, by whatever name or link.
[[nodiscard]] Result<void> check_output_is_no_input(const std::filesystem::path& output,
                                                    std::span<const std::filesystem::path> inputs);

} // namespace frustumscreen
