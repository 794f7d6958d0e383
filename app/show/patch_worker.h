/// The thread that makes the patches of frozen windows, in the time that the picture leaves.
///
/// Threads  `work_on` from one thread, which never waits. The worker's own thread has a low priority; it sleeps without work.
///          Destruction waits until its piece of work is done.
/// Errors   those of jobs (patch_job.h).
#pragma once

#include "app/show/patch_job.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

namespace frustumscreen::show {

using PatchJobs = std::vector<std::shared_ptr<PatchJob>>;

/// The job to go on with: one that lacks the patch that is looked at, otherwise one that is not done; null: all are done.
[[nodiscard]] PatchJob* next_job(const PatchJobs& jobs);

class PatchWorker {
public:
    PatchWorker();
    ~PatchWorker();
    PatchWorker(const PatchWorker&) = delete;
    PatchWorker& operator=(const PatchWorker&) = delete;

    /// From now on these and no others, the most urgent first.
    void work_on(PatchJobs jobs);
    /// Wakes the thread: an eye looks at another patch.
    void look_again();
    /// It sleeps: destruction does not wait.
    [[nodiscard]] bool rests() const { return rests_; }

private:
    void work();

    std::atomic<PatchJobs*> given_{nullptr}; ///< owned by whichever thread exchanges it out
    std::atomic<std::uint32_t> news_{0};     ///< changes with every call
    std::atomic<bool> ends_{false}, rests_{false};
    std::jthread thread_; ///< last: it uses the others
};

} // namespace frustumscreen::show
