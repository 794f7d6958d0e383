/// Runs another program, bounded in time, memory and output.
///
/// Errors   one sentence: it cannot be started; of `run_program` also: it takes too long, writes too much, ends with an error (with
///          the first line that it wrote about it). It and what it started are then ended, and also when we end before, even by
///          SIGKILL.
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
    std::size_t complaint_bytes = 200; ///< of standard error that are kept; the rest is passed over
    std::uint64_t memory_bytes = 0;    ///< of each process' data; 0: no limit
    std::function<bool()> given_up{};  ///< asked ten times a second; where it says yes, the program is ended
};

/// `command`: the program, searched for in PATH, and its arguments. Returns what it writes to standard output.
[[nodiscard]] Result<Bytes> run_program(const std::vector<std::string>& command, std::string_view input,
                                        const ProgramLimits& limits = {});

/// How a program that could be started has ended.
struct ProgramEnd {
    enum class How : std::uint8_t { ByItself, TooLate, TooMuch, GivenUp };
    How how = How::ByItself;
    int status = 0; ///< by itself: its exit status, or minus the signal's number
    Bytes output;
    std::string complaint; ///< the beginning of what it wrote to standard error
};
[[nodiscard]] Result<ProgramEnd> follow_program(const std::vector<std::string>& command,
                                                std::string_view input, const ProgramLimits& limits);

} // namespace frustumscreen
