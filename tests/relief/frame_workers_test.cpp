#include "app/relief/frame_workers.h"

#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <barrier>
#include <csignal>
#include <numeric>
#include <thread>
#include <vector>

namespace frustumscreen::relief {
namespace {

bool leaves_to_others(int signal) {
    sigset_t blocked;
    sigemptyset(&blocked);
    ::pthread_sigmask(SIG_BLOCK, nullptr, &blocked);
    return sigismember(&blocked, signal) == 1;
}

TEST(FrameWorkers, ProcessEachPieceOnce) {
    for (const int threads : {1, 2, 5}) {
        FrameWorkers workers(threads);
        for (const int count : {0, 1, 2, 1000}) {
            std::vector<int> done(static_cast<std::size_t>(count), 0);
            std::vector<int> of_thread(static_cast<std::size_t>(threads),
                                       0); // shared numbers would race
            workers.share(count, [&](int k, int thread) {
                ++done[static_cast<std::size_t>(k)];
                ++of_thread.at(static_cast<std::size_t>(thread));
            });
            EXPECT_EQ(std::accumulate(of_thread.begin(), of_thread.end(), 0), count) << threads;
            EXPECT_EQ(std::accumulate(done.begin(), done.end(), 0), count) << threads;
            EXPECT_EQ(std::count(done.begin(), done.end(), 1), count) << threads;
        }
    }
}

/// A stop signal for the exhibit would end it at once in a thread that does not block the signal.
TEST(FrameWorkers, BlockStopSignalsInWorkerThreads) {
    constexpr int threads = 3;
    FrameWorkers workers(threads);
    std::barrier all(threads); // makes each thread take one piece
    const std::thread::id caller = std::this_thread::get_id();
    std::vector<int> leaves(threads, 0);
    workers.share(threads, [&](int k, int) {
        all.arrive_and_wait();
        leaves[static_cast<std::size_t>(k)] =
            std::this_thread::get_id() == caller || (leaves_to_others(SIGTERM) && leaves_to_others(SIGINT))
                ? 1
                : 0;
    });
    EXPECT_EQ(leaves, std::vector<int>(threads, 1));
}

} // namespace
} // namespace frustumscreen::relief
