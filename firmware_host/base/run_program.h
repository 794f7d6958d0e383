/// Runs another program, bounded in time, memory and output.
///
/// Errors   one sentence. Both functions: it cannot be started. `run_program` also: it takes too long, writes
///          too much, or fails (with the first line of its standard error). The program and its children are
///          then killed; so are they when this process ends first, even by SIGKILL.
/// Threads  any; waits for the program.
#pragma once

#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

struct ProgramLimits {
    std::chrono::milliseconds time{30000};
    std::size_t output_bytes = std::size_t{64} << 20;
    std::size_t complaint_bytes = 200; ///< standard error to keep; the rest is discarded
    std::uint64_t memory_bytes = 0;    ///< limit of each process' data; 0: no limit
    std::function<bool()> given_up{};  ///< polled ten times a second; true ends the program
};

/// `command`: the program, searched for in PATH, and its arguments. Returns its standard output.
[[nodiscard]] Result<Bytes> run_program(const std::vector<std::string>& command, std::string_view input,
                                        const ProgramLimits& limits = {});

/// How a started program ended.
struct ProgramEnd {
    enum class How : std::uint8_t { ByItself, TooLate, TooMuch, GivenUp };
    How how = How::ByItself;
    int status = 0; ///< ByItself: its exit status, or minus the signal's number
    Bytes output;
    std::string complaint; ///< the beginning of its standard error
};
[[nodiscard]] Result<ProgramEnd> follow_program(const std::vector<std::string>& command,
                                                std::string_view input, const ProgramLimits& limits);

} // namespace frustumscreen
