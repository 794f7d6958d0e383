// The start of a worker's thread, and the end of its sleep.
#include "firmware_host/base/device_thread.h"
#include "tests/render/counted_new.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <string>
#include <thread>

namespace frustumscreen {
namespace {

int niceness() {
    return ::getpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()));
}

TEST(DeviceThread, SetsNameAndPriorityAndBlocksStopSignals) {
    const int usual = niceness();
    for (const ThreadPriority priority : {ThreadPriority::Usual, ThreadPriority::Low}) {
        std::jthread([&] {
            begin_device_thread("a name", priority);
            char name[16]{};
            EXPECT_EQ(::pthread_getname_np(::pthread_self(), name, sizeof name), 0);
            EXPECT_EQ(std::string(name), "a name");
            EXPECT_EQ(niceness(), priority == ThreadPriority::Low ? 5 : usual);
            sigset_t blocked;
            ASSERT_EQ(::pthread_sigmask(SIG_BLOCK, nullptr, &blocked), 0);
            EXPECT_TRUE(sigismember(&blocked, SIGTERM) == 1 && sigismember(&blocked, SIGINT) == 1);
        }).join();
    }
    EXPECT_EQ(niceness(), usual) << "of the calling thread alone";
}

/// If a stop did not end the sleep, ctest's timeout would end this test.
TEST(SleepUntilStop, EndsWhenAStopIsRequestedBeforeOrDuringIt) {
    constexpr Nanoseconds forever = std::chrono::hours(1000);
    std::stop_source before;
    before.request_stop();
    sleep_until_stop(before.get_token(), forever);
    for (int k = 0; k < 200; ++k) {
        std::atomic<bool> begins = false;
        std::jthread sleeper([&](const std::stop_token& stop) {
            begins = true;
            begins.notify_one();
            sleep_until_stop(stop, forever);
        });
        begins.wait(false);
    }
}

TEST(SleepUntilStop, SleepsItsTimeAndAllocatesNothing) {
    const std::stop_source never;
    const std::stop_token stop = never.get_token();
    const long before = synthetic::allocations_so_far();
    const MonotonicTime begin = monotonic_now();
    sleep_until_stop(stop, std::chrono::milliseconds(20));
    EXPECT_GE(monotonic_now() - begin, std::chrono::milliseconds(20));
    EXPECT_EQ(synthetic::allocations_so_far(), before);
}

} // namespace
} // namespace frustumscreen
