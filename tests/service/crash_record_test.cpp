// Compares crash records with addr2line's output for this program.
#include "firmware_host/base/crash_file.h"
#include "firmware_host/base/this_boot.h"
#include "firmware_host/service/crash_record.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <functional>
#include <sstream>
#include <thread>

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace frustumscreen::service {
namespace {

namespace fs = std::filesystem;

extern "C" {
// addr2line must find these names. Not inlined, no tail calls.
[[gnu::noinline]] void crash_in_the_innermost_function(volatile int* nowhere) {
    *nowhere = 1;
}
[[gnu::noinline]] void crash_from_its_caller(volatile int* nowhere) {
    crash_in_the_innermost_function(nowhere);
    *nowhere = 2;
}
}

class CrashRecord : public testing::Test {
protected:
    CrashRecord() {
        std::string pattern = (fs::temp_directory_path() / "crashes.XXXXXX").string();
        folder_ = ::mkdtemp(pattern.data());
        records_ = folder_;
    }
    ~CrashRecord() override { fs::remove_all(folder_); }

    /// Runs `work` in a child that records crashes; returns the signal that ends it. Its standard error is in
    /// `said_`.
    int signal_that_ends(const std::function<void()>& work) {
        ::testing::internal::CaptureStderr();
        const pid_t child = ::fork();
        if (child == 0) {
            ::alarm(20); // guards against a hang
            record_crashes({records_, "1.2.3", "Debian, Linux"});
            work();
            ::_exit(7);
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        said_ = ::testing::internal::GetCapturedStderr();
        return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    }
    [[nodiscard]] std::string record(int number = 1) const {
        std::ostringstream text;
        text << std::ifstream(folder_ / crash_file_name(number)).rdbuf();
        return text.str();
    }
    [[nodiscard]] static std::string value(const std::string& text, const std::string& key) {
        const std::size_t at = text.find("\n" + key + " ");
        const std::size_t begin = at + key.size() + 2;
        return at == std::string::npos ? "" : text.substr(begin, text.find('\n', begin) - begin);
    }
    /// The function at the k-th frame, named by addr2line; the frame must belong to this program.
    [[nodiscard]] static std::string function_of_frame(const std::string& text, int k) {
        std::size_t at = 0;
        for (int skipped = -1; skipped < k; ++skipped) {
            at = text.find("\nframe ", at + 1);
        }
        const std::string frame = text.substr(at + 7, text.find('\n', at + 1) - at - 7);
        const std::string program = fs::read_symlink("/proc/self/exe").string();
        EXPECT_TRUE(frame.starts_with(fs::path(program).filename().string() + "+0x")) << frame;
        const std::string command = "addr2line -f -e '" + program + "' " + frame.substr(frame.rfind('+') + 1);
        FILE* const pipe = ::popen(command.c_str(), "r"); // NOLINT(cert-env33-c)
        char line[256] = "";
        EXPECT_NE(std::fgets(line, sizeof line, pipe), nullptr);
        ::pclose(pipe);
        return std::string(line, std::strcspn(line, "\n"));
    }

    fs::path folder_;
    fs::path records_; ///< for the child's records
    std::string said_;
};

TEST_F(CrashRecord, TheLastLineIsSaidAndTheCrashTakesItsCourse) {
    for (const int signal : {SIGSEGV, SIGBUS, SIGABRT}) {
        EXPECT_EQ(signal_that_ends([signal] { ::raise(signal); }), signal);
        EXPECT_TRUE(said_.starts_with("frustumscreen: crashed: ")) << said_;
        EXPECT_EQ(said_.back(), '\n');
    }
}

TEST_F(CrashRecord, SaysWhereItWas) {
    EXPECT_EQ(signal_that_ends([] {
                  note_driver_for_crashes("llvmpipe\n(LLVM)");
                  crash_from_its_caller(nullptr);
              }),
              SIGSEGV);
    const std::string text = record();
    EXPECT_TRUE(text.starts_with("frustumscreen-crash-1\n")) << text;
    EXPECT_TRUE(text.ends_with("\nend\n")) << text;
    EXPECT_EQ(value(text, "signal"), "SIGSEGV");
    EXPECT_EQ(value(text, "boot"), boot_id());
    EXPECT_EQ(value(text, "program"), "1.2.3");
    EXPECT_EQ(value(text, "system"), "Debian, Linux");
    EXPECT_EQ(value(text, "driver"), "llvmpipe (LLVM)");
    EXPECT_NEAR(std::stod(value(text, "unix_s")), static_cast<double>(std::time(nullptr)), 30.0);
    EXPECT_EQ(function_of_frame(text, 0), "crash_in_the_innermost_function") << text;
    EXPECT_EQ(function_of_frame(text, 1), "crash_from_its_caller") << text;
}

TEST_F(CrashRecord, OfAnotherThreadWhichIsNamed) {
    EXPECT_EQ(signal_that_ends([] {
                  std::thread([] {
                      ::prctl(PR_SET_NAME, "worker-3");
                      crash_from_its_caller(nullptr);
                  }).join();
              }),
              SIGSEGV);
    EXPECT_EQ(value(record(), "thread"), "worker-3");
    EXPECT_EQ(function_of_frame(record(), 0), "crash_in_the_innermost_function");
}

/// Code generated by a driver: unknown to any unwinder. The record must show its caller.
TEST_F(CrashRecord, InCompiledCodeTheStackSaysWhoCalledIt) {
    EXPECT_EQ(signal_that_ends([] {
                  void* const page = ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE | PROT_EXEC,
                                            MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
                  std::memcpy(page, "\x0f\x0b", 2); // ud2
                  reinterpret_cast<void (*)()>(page)();
              }),
              SIGILL);
    const std::string text = record();
    EXPECT_TRUE(value(text, "frame").starts_with("compiled+0x")) << text;
    EXPECT_TRUE(value(text, "guess").starts_with("service_test+0x")) << text;
    EXPECT_TRUE(text.ends_with("\nend\n")) << text;
}

/// The stack is exhausted: the handler has its own stack.
TEST_F(CrashRecord, AnOverflownStack) {
    struct Deep {
        // NOLINTNEXTLINE(misc-no-recursion)
        static int down(volatile char* above) {
            volatile char here[4096];
            here[0] = *above;
            return here[0] == 1 ? 0 : down(here) + here[0];
        }
    };
    EXPECT_EQ(signal_that_ends([] {
                  volatile char top = 0;
                  ::_exit(Deep::down(&top));
              }),
              SIGSEGV);
    EXPECT_TRUE(record().ends_with("\nend\n")) << record();
}

TEST_F(CrashRecord, TheLastThreeStay) {
    for (int k = 1; k <= 5; ++k) {
        EXPECT_EQ(signal_that_ends([k] {
                      ::prctl(PR_SET_NAME, ("thread-" + std::to_string(k)).c_str());
                      crash_from_its_caller(nullptr);
                  }),
                  SIGSEGV);
        std::this_thread::sleep_for(std::chrono::milliseconds(20)); // files with equal times have no order
    }
    EXPECT_EQ(value(record(1), "thread"), "thread-4");
    EXPECT_EQ(value(record(2), "thread"), "thread-5");
    EXPECT_EQ(value(record(3), "thread"), "thread-3");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 3);
    EXPECT_LE(fs::file_size(folder_ / crash_file_name(1)), 8192U);
}

TEST_F(CrashRecord, AFolderThatCannotBeWrittenCostsOnlyTheFile) {
    records_ = "/proc/no-such-folder";
    EXPECT_EQ(signal_that_ends([] { crash_from_its_caller(nullptr); }), SIGSEGV);
    EXPECT_TRUE(said_.starts_with("frustumscreen: crashed: ")) << said_;
}

} // namespace
} // namespace frustumscreen::service

#endif
