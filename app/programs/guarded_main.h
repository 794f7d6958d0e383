/// The last net under every program: what no room has turned into a Result ends in one line and status 1.
///
/// Threads  the main one.
#pragma once

#include <cstdio>
#include <exception>
#include <new>

namespace frustumscreen {

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

} // namespace frustumscreen
