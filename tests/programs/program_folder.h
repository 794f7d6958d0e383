// A new folder in which a test runs the programs as a person would.
#pragma once

#include "firmware_host/base/file.h"
#include "tests/base/temporary_folder.h"
#include "tests/folders.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <string>

namespace frustumscreen::programs {

class ProgramFolder : public WithTemporaryFolder {
protected:
    /// Runs `command`, which begins with a program's name; returns the exit status. Its output goes to out.txt and
    /// err.txt.
    [[nodiscard]] int run(const std::string& command) const {
        const int status =
            std::system(fmt::format("cd '{}' && ASAN_OPTIONS=detect_leaks=0 '{}'/{} >out.txt 2>err.txt",
                                    folder.string(), bin_dir(), command)
                            .c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    /// Writes star.obj: eight unequal triangles.
    void write_star() const {
        ASSERT_TRUE(
            write_file(folder / "star.obj",
                       as_bytes("v 1 0 0\nv -0.7 0 0\nv 0 0.8 0\nv 0 -0.9 0\nv 0 0 1.1\nv 0 0 -1\n"
                                "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n")));
    }
    [[nodiscard]] std::string text(const std::string& file) const {
        const Result<Bytes> bytes = read_file(folder / file);
        return bytes ? std::string(as_text(*bytes)) : std::string();
    }
};

} // namespace frustumscreen::programs
