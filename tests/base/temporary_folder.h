/// A folder of a test's own, which is deleted with its contents; and a test that has one: it writes files there, runs
/// commands, and reads what they leave.
#pragma once

#include "tests/base/text_of.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

namespace frustumscreen {

class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = std::filesystem::temp_directory_path() / "frustumscreen_XXXXXX";
        if (::mkdtemp(name.data()) == nullptr) {
            throw std::runtime_error("there is no folder " + name);
        }
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code failed;
        std::filesystem::remove_all(path_, failed);
        EXPECT_FALSE(failed) << path_ << ": " << failed.message();
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    /// Writes a file, and makes the folders that it needs. Returns its path.
    std::filesystem::path write(const std::filesystem::path& file, std::string_view content) const {
        std::filesystem::create_directories((path_ / file).parent_path());
        std::ofstream stream(path_ / file, std::ios::binary);
        EXPECT_TRUE((stream << content).flush()) << file;
        return path_ / file;
    }

private:
    std::filesystem::path path_;
};

class WithTemporaryFolder : public ::testing::Test {
protected:
    /// Writes a file, and makes the folders that it needs.
    void put(const std::filesystem::path& file, std::string_view content) const { own_.write(file, content); }
    /// The contents of a file; empty where there is none.
    [[nodiscard]] std::string text(const std::filesystem::path& file) const { return text_of(folder / file); }
    /// Runs commands of the shell in the folder. Returns the exit status; -1: a signal ended them.
    [[nodiscard]] int shell(const std::string& commands) const {
        const int status = std::system(("cd '" + folder.string() + "' || exit 4; " + commands).c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

private:
    const TemporaryFolder own_;

protected:
    const std::filesystem::path& folder = own_.path();
};

} // namespace frustumscreen
