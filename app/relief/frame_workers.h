/// Threads that share a frame's work with the thread that draws it.
///
/// Threads  `threads` - 1 of its own, from construction to destruction; they sleep between calls of `share`.
///          One caller at a time.
/// Memory   `share` allocates nothing.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace frustumscreen::relief {

class FrameWorkers {
public:
    explicit FrameWorkers(int threads);
    ~FrameWorkers();
    FrameWorkers(const FrameWorkers&) = delete;
    FrameWorkers& operator=(const FrameWorkers&) = delete;

    [[nodiscard]] int threads() const { return static_cast<int>(threads_.size()) + 1; }

    /// Calls body(k, thread) once for each k of [0, count), on all threads (0 is the caller's) in any order;
    /// returns when all are done. `body` must not throw.
    template <typename Body> void share(int count, const Body& body) {
        share(count,
              {&body, [](const void* of, int k, int thread) { (*static_cast<const Body*>(of))(k, thread); }});
    }

private:
    /// A body without its type, so that passing it on allocates nothing.
    struct Work {
        const void* body = nullptr;
        void (*call)(const void* body, int k, int thread) = nullptr;
    };
    void share(int count, Work work);
    void take(const Work& work, int count, int thread);
    void work_until_closed(int thread);

    std::atomic<int> next_{0};
    std::mutex mutex_; ///< guards all that follows
    std::condition_variable begun_, done_;
    Work work_;
    int count_ = 0;
    std::uint64_t round_ = 0;
    std::size_t busy_ = 0;
    bool closed_ = false;
    std::vector<std::thread> threads_; ///< last: they use the others
};

} // namespace frustumscreen::relief
