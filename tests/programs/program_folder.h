// A new folder in which a test runs the programs as a person would.
#pragma once

#include "firmware_host/base/file.h"
#include "tests/base/temporary_folder.h"
#include "tests/folders.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

namespace frustumscreen::programs {

class ProgramFolder : public WithTemporaryFolder {
protected:
    /// Runs `command`, which begins with a program's name; returns the exit status. Its output goes to out.txt and
    /// err.txt.
    [[nodiscard]] int run(const std::string& command) const {
        return shell(
            fmt::format("ASAN_OPTIONS=detect_leaks=0 '{}'/{} >out.txt 2>err.txt", bin_dir(), command));
    }
    /// Writes star.obj: eight unequal triangles.
    void write_star() const {
        put("star.obj", "v 1 0 0\nv -0.7 0 0\nv 0 0.8 0\nv 0 -0.9 0\nv 0 0 1.1\nv 0 0 -1\n"
                        "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n");
    }
};

} // namespace frustumscreen::programs
