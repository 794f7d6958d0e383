// A camera's frames stay in memory. The kernel is the witness: strace records every call of a process while
// frames pass through this module, and each call must be one that neither writes nor sends.
#include "tests/base/temporary_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// Calls for memory, threads, time and reading. All others write, send, or are unexpected.
const std::set<std::string> harmless{"access",
                                     "arch_prctl",
                                     "brk",
                                     "clock_gettime",
                                     "clock_nanosleep",
                                     "clone",
                                     "clone3",
                                     "close",
                                     "execve",
                                     "exit",
                                     "exit_group",
                                     "fstat",
                                     "fstatfs",
                                     "futex",
                                     "getdents64",
                                     "getpid",
                                     "getrandom",
                                     "getrlimit",
                                     "gettid",
                                     "ioctl",
                                     "lseek",
                                     "madvise",
                                     "mprotect",
                                     "munmap",
                                     "newfstatat",
                                     "poll",
                                     "pread64",
                                     "prlimit64",
                                     "read",
                                     "readlink",
                                     "rseq",
                                     "rt_sigaction",
                                     "rt_sigprocmask",
                                     "rt_sigreturn",
                                     "sched_getaffinity",
                                     "sched_yield",
                                     "set_robust_list",
                                     "set_tid_address",
                                     "sysinfo",
                                     "restart_syscall",
                                     "uname"};

bool has(const std::string& text, const std::string& word) {
    return text.find(word) != std::string::npos;
}

/// Classifies one strace line: the call's name, then its arguments.
bool is_harmless(const std::string& call) {
    const std::string name = call.substr(0, call.find('('));
    if (name == "openat" && has(call, "\"/dev/video")) {
        return has(call, "O_RDWR") &&
               !has(call, "O_CREAT"); // the camera itself; writing to it is a different call
    }
    if (name == "open" || name == "openat") {
        return has(call, "O_RDONLY") && !has(call, "O_CREAT") && !has(call, "O_TRUNC");
    }
    if (name == "mmap") {
        return !(has(call, "MAP_SHARED") && has(call, "PROT_WRITE"));
    }
    if (name == "write") {
        return call.rfind("write(1, ", 0) == 0 && has(call, " frames\\n\""); // its only line
    }
    if (name == "fcntl") {
        return has(call, "F_GETFL") || has(call, "F_SETFD"); // listing a folder
    }
    if (name == "prctl") {
        return has(call, "PR_SET_NAME"); // of a thread
    }
    return harmless.contains(name);
}

class KeepsNothing : public frustumscreen::WithTemporaryFolder {
protected:
    /// Runs a program under strace; returns all calls.
    [[nodiscard]] std::vector<std::string> calls_of(const std::string& program) const {
        EXPECT_EQ(shell("strace -f -qq -o trace " + program + " > said"), 0) << program;
        std::vector<std::string> calls;
        std::istringstream trace(text("trace"));
        for (std::string line; std::getline(trace, line);) {
            const std::size_t begin = line.find_first_not_of("0123456789 ");
            const std::string call = begin == std::string::npos ? "" : line.substr(begin);
            const bool ends_another =
                call.rfind("<... ", 0) == 0; // "resumed": the call's beginning was counted
            if (!ends_another && call.rfind("+++", 0) != 0 && call.rfind("---", 0) != 0) {
                calls.push_back(call);
            }
        }
        return calls;
    }
};

TEST_F(KeepsNothing, OpensNoFileForWritingAndSendsNothing) {
    const std::vector<std::string> calls = calls_of(FRUSTUMSCREEN_FRAMES_IN_MEMORY);
    EXPECT_EQ(text("said"), "60 frames\n");
    EXPECT_GT(calls.size(), 100U);
    for (const std::string& call : calls) {
        EXPECT_TRUE(is_harmless(call)) << call;
    }
    EXPECT_TRUE(std::any_of(calls.begin(), calls.end(), [](const std::string& call) {
        return has(call, "\"/dev/video_that_is_none\", O_RDWR");
    })) << "the way in which the kernel's cameras are opened was seen";
}

TEST_F(KeepsNothing, DetectsAWrittenFrame) {
    const std::vector<std::string> calls =
        calls_of(FRUSTUMSCREEN_FRAMES_IN_MEMORY " " + (folder / "frame").string());
    ASSERT_TRUE(fs::exists(folder / "frame"));
    EXPECT_GE(std::count_if(calls.begin(), calls.end(), [](const auto& call) { return !is_harmless(call); }),
              2)
        << "its opening and its writing";
}

/// Every use of the exhibit's frames. One small file of drift marks is kept: it is opened, written and
/// renamed, and nothing else may be; a frame is 57 600 bytes.
class UsesKeepNothing : public KeepsNothing {
protected:
    UsesKeepNothing() { fs::create_directories(kept_); }
    /// Collects the writing calls in order, separately for the drift file and the rest.
    void run(const std::string& option) {
        for (const std::string& call : calls_of(FRUSTUMSCREEN_USES_IN_MEMORY " " + kept_.string() + option)) {
            if (!is_harmless(call)) {
                (is_of_drift(call) ? of_drift_ : others_).push_back(call);
            }
        }
    }
    fs::path kept_ = folder / "kept";
    std::vector<std::string> of_drift_, others_;
    unsigned long written_ = 0; ///< bytes, into the drift file

private:
    /// Its opening and its renaming contain its name; between them its descriptor is written.
    bool is_of_drift(const std::string& call) {
        const std::string file = "\"" + (kept_ / "drift.json").string();
        const std::string result = call.substr(call.rfind("= ") + 2);
        if (call.rfind("openat(", 0) == 0 && has(call, file + ".part") && has(call, "O_CREAT")) {
            descriptor_ = result;
            return true;
        }
        if (call.rfind("rename(" + file + ".part", 0) == 0 && has(call, ", " + file + "\")")) {
            descriptor_.clear();
            return true;
        }
        if (!descriptor_.empty() && call.rfind("write(" + descriptor_ + ", ", 0) == 0) {
            written_ += std::stoul(result);
            return true;
        }
        return !descriptor_.empty() && call.rfind("fsync(" + descriptor_ + ")", 0) == 0;
    }
    std::string descriptor_;
};

TEST_F(UsesKeepNothing, WriteOnlyTheDriftFile) {
    run("");
    EXPECT_EQ(text("said"), "enough frames\n");
    for (const std::string& call : others_) {
        ADD_FAILURE() << call;
    }
    EXPECT_GE(of_drift_.size(), 3U) << "opened, written, named";
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(kept_)) {
        files.push_back(entry.path().filename());
    }
    ASSERT_EQ(files, std::vector<fs::path>{"drift.json"});
    EXPECT_EQ(fs::file_size(kept_ / "drift.json"), written_);
    EXPECT_LT(written_, 4096U);
}

TEST_F(UsesKeepNothing, DetectsAWrittenFrame) {
    run(" " + (kept_ / "frame").string());
    ASSERT_EQ(fs::file_size(kept_ / "frame"), 320U * 180U);
    EXPECT_GE(others_.size(), 2U) << "its opening and its writing";
}

} // namespace
