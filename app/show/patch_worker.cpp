#include "app/show/patch_worker.h"

#include "firmware_host/base/device_thread.h"

#include <algorithm>

namespace frustumscreen::show {

PatchJob* next_job(std::span<PatchJob> jobs) {
    const auto first = [&](const auto& is_wanted) -> PatchJob* {
        const auto found = std::find_if(jobs.begin(), jobs.end(), is_wanted);
        return found != jobs.end() ? &*found : nullptr;
    };
    PatchJob* const left = first([](const PatchJob& job) { return job.is_left(); });
    PatchJob* const lacks_first =
        left != nullptr ? left
                        : first([](const PatchJob& job) { return job.needs_work() && !job.has_first(); });
    return lacks_first != nullptr ? lacks_first : first([](const PatchJob& job) { return job.needs_work(); });
}

PatchWorker::PatchWorker(std::span<PatchJob> jobs) : jobs_(jobs), thread_([this] { work(); }) {}

PatchWorker::~PatchWorker() {
    ends_ = true;
    look_again();
    thread_.join();
}

void PatchWorker::look_again() {
    ++news_;
    news_.notify_one();
}

void PatchWorker::work() {
    begin_device_thread("windows", ThreadPriority::Low);
    while (!ends_) {
        const std::uint32_t news = news_;
        if (PatchJob* const job = next_job(jobs_)) {
            job->step();
        } else {
            news_.wait(news);
        }
    }
}

} // namespace frustumscreen::show
