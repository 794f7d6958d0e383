#include "firmware_host/service/stop_signals.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <thread>

namespace frustumscreen::service {
namespace {

/// How a child that does `work` and then exits with 7 ends.
int ending_of(const std::function<void()>& work) {
    const pid_t child = ::fork();
    if (child == 0) {
        work();
        ::_exit(7);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return status;
}

TEST(StopSignals, AreHeldUntilTheyArePolled) {
    const int status = ending_of([] {
        const StopSignals signals;
        if (signals.received()) {
            ::_exit(1);
        }
        ::kill(::getpid(), SIGTERM);
        if (!signals.received() || signals.received()) {
            ::_exit(2);
        }
        ::kill(::getpid(), SIGINT);
        if (!signals.received()) {
            ::_exit(3);
        }
    });
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 7);
}

TEST(StopSignals, EndTheProcessAtOnceWithinAtOnce) {
    const int status = ending_of([] {
        const StopSignals signals;
        const StopSignals::AtOnce at_once(signals);
        ::kill(::getpid(), SIGTERM);
        ::pause(); // another thread takes the signal
    });
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(WTERMSIG(status), SIGTERM);
    const int after = ending_of([] {
        const StopSignals signals;
        { const StopSignals::AtOnce at_once(signals); }
        ::kill(::getpid(), SIGTERM); // waits again
    });
    ASSERT_TRUE(WIFEXITED(after));
    EXPECT_EQ(WEXITSTATUS(after), 7);
}

TEST(StopSignals, AreNotTakenByAThreadStartedWithinAtOnce) {
    const int status = ending_of([] {
        const StopSignals signals;
        std::jthread device;
        {
            const StopSignals::AtOnce at_once(signals);
            std::atomic<bool> begun{false};
            device = std::jthread([&begun](const std::stop_token& stop) {
                begun = true; // on a busy machine it may not have come to begin_device_thread
                while (!stop.stop_requested()) {
                    std::this_thread::sleep_for(std::chrono::milliseconds(1));
                }
            });
            while (!begun) {
                std::this_thread::yield();
            }
        }
        ::kill(::getpid(), SIGTERM);
        std::this_thread::sleep_for(std::chrono::milliseconds(20)); // time for the kernel to choose a thread
        if (!signals.received()) {
            ::_exit(1);
        }
    });
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 7);
}

TEST(StopSignals, HangingThreadDoesNotDelayTheExit) {
    const int status = ending_of([] {
        const StopSignals signals;
        ::close(STDERR_FILENO);
        std::jthread hangs([] { std::this_thread::sleep_for(std::chrono::hours(1)); });
        end_within(std::chrono::milliseconds(50), 7);
        hangs.join();
    });
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 7);
}

} // namespace
} // namespace frustumscreen::service
