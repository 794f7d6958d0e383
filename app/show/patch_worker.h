/// The thread that makes the patches of frozen windows, in the time that the picture leaves.
///
/// Threads  `look_again` from one thread, which never waits. The worker's own thread has a low priority; it sleeps without work.
///          Destruction waits until its piece of work is done.
/// Errors   those of jobs (patch_job.h).
#pragma once

#include "app/show/patch_job.h"

#include <atomic>
#include <cstdint>
#include <span>
#include <thread>

namespace frustumscreen::show {

/// The job to go on with: one that was left, otherwise one that lacks the patch that is looked at, otherwise one that is not done;
/// null: none needs work.
[[nodiscard]] PatchJob* next_job(std::span<PatchJob> jobs);

class PatchWorker {
public:
    /// The jobs must outlive it.
    explicit PatchWorker(std::span<PatchJob> jobs);
    ~PatchWorker();
    PatchWorker(const PatchWorker&) = delete;
    PatchWorker& operator=(const PatchWorker&) = delete;

    /// Wakes the thread: a job was begun or left, or an eye looks at another patch.
    void look_again();

private:
    void work();

    std::span<PatchJob> jobs_;
    std::atomic<std::uint32_t> news_{0}; ///< changes with every call
    std::atomic<bool> ends_{false};
    std::jthread thread_; ///< last: it uses the others
};

} // namespace frustumscreen::show
