// A new folder in which a test runs our programs as a person would.
#pragma once

#include "firmware_host/base/file.h"
#include "tests/base/temporary_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace frustumscreen {

class ProgramFolder : public WithTemporaryFolder {
protected:
    /// `command` begins with a program's name; returns the exit status. Its output goes to out.txt and
    /// err.txt.
    [[nodiscard]] int run(const std::string& command) const {
        const int status =
            std::system(fmt::format("cd '{}' && ASAN_OPTIONS=detect_leaks=0 '{}'/{} >out.txt 2>err.txt",
                                    folder.string(), FRUSTUMSCREEN_BIN_DIR, command)
                            .c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    [[nodiscard]] std::string text(const std::string& file) const {
        const Result<Bytes> bytes = read_file(folder / file);
        return bytes ? std::string(as_text(*bytes)) : std::string();
    }
};

} // namespace frustumscreen
