/// Runs a program of somebody else on a text, bounded in time and output.
///
/// Errors   one sentence: it cannot be started, takes too long, writes too much, ends with an error (with the first line that it
///          wrote about it). It and what it started are then ended, and also when we end before, even by SIGKILL.
/// Threads  any; waits for the program.
#pragma once

#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

struct ProgramLimits {
    std::chrono::milliseconds time{30000};
    std::size_t output_bytes = std::size_t{64} << 20;
};

/// `command`: the program, searched for in PATH, and its arguments. Returns what it writes to standard output.
[[nodiscard]] Result<Bytes> run_program(const std::vector<std::string>& command, std::string_view input,
                                        const ProgramLimits& limits = {});

} // namespace frustumscreen
