#include "app/show/patch_worker.h"

#include "firmware_host/base/device_thread.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::show {

PatchJob* next_job(const PatchJobs& jobs) {
    const auto lacks_first =
        std::find_if(jobs.begin(), jobs.end(), [](const auto& job) { return !job->has_first(); });
    const auto next =
        lacks_first != jobs.end()
            ? lacks_first
            : std::find_if(jobs.begin(), jobs.end(), [](const auto& job) { return !job->is_done(); });
    return next != jobs.end() ? next->get() : nullptr;
}

PatchWorker::PatchWorker() : thread_([this] { work(); }) {}

PatchWorker::~PatchWorker() {
    ends_ = true;
    look_again();
    thread_.join();
    delete given_.load();
}

void PatchWorker::work_on(PatchJobs jobs) {
    delete given_.exchange(std::make_unique<PatchJobs>(std::move(jobs)).release());
    look_again();
}

void PatchWorker::look_again() {
    ++news_;
    news_.notify_one();
}

void PatchWorker::work() {
    begin_device_thread("windows", ThreadPriority::Low);
    PatchJobs jobs;
    while (!ends_) {
        rests_ = false;
        const std::uint32_t news = news_;
        if (const std::unique_ptr<PatchJobs> given{given_.exchange(nullptr)}) {
            jobs = std::move(*given);
        }
        if (PatchJob* const job = next_job(jobs)) {
            job->step();
        } else {
            jobs.clear(); // done; the thread that draws keeps them
            rests_ = true;
            news_.wait(news);
        }
    }
}

} // namespace frustumscreen::show
