/// The last safety net of every program: an exception that no module turned into a Result ends in one line
/// and status 1.
///
/// Threads  the main thread.
#pragma once

#include "firmware_host/base/result.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>

namespace frustumscreen::programs {

/// One line on standard error: the program, the sentence, and its id in brackets.
inline void complain(const char* program, const Error& error) {
    fmt::print(stderr, "{}: {} [{}]\n", program, error.message, error.id.view());
}

/// Returns 0; or prints the error in one line to standard error and returns 1.
[[nodiscard]] inline int exit_status(const char* program, const Result<void>& result) {
    if (!result) {
        complain(program, result.error());
    }
    return result ? 0 : 1;
}

inline int guarded_main(const char* program, int (*run)(int, char**), int argc, char** argv) noexcept {
    try {
        return run(argc, argv);
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "%s: not enough memory\n", program);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", program, error.what());
    } catch (...) {
        std::fprintf(stderr, "%s: stopped by an unknown error\n", program);
    }
    return 1;
}

} // namespace frustumscreen::programs
