#include "app/relief/frame_workers.h"

#include "firmware_host/base/device_thread.h"

namespace frustumscreen::relief {

FrameWorkers::FrameWorkers(int threads) {
    for (int k = 1; k < threads; ++k) {
        threads_.emplace_back([this, k] { work_until_closed(k); });
    }
}

FrameWorkers::~FrameWorkers() {
    {
        const std::lock_guard lock(mutex_);
        closed_ = true;
    }
    begun_.notify_all();
    for (std::thread& thread : threads_) {
        thread.join();
    }
}

void FrameWorkers::share(int count, Work work) {
    next_.store(0, std::memory_order_relaxed);
    if (!threads_.empty() && count > 1) {
        const std::lock_guard lock(mutex_);
        work_ = work;
        count_ = count;
        busy_ = threads_.size();
        ++round_;
        begun_.notify_all();
    }
    take(work, count, 0);
    std::unique_lock lock(mutex_);
    done_.wait(lock, [this] { return busy_ == 0; });
}

void FrameWorkers::take(const Work& work, int count, int thread) {
    for (int k = next_.fetch_add(1, std::memory_order_relaxed); k < count;
         k = next_.fetch_add(1, std::memory_order_relaxed)) {
        work.call(work.body, k, thread);
    }
}

void FrameWorkers::work_until_closed(int thread) {
    begin_device_thread("relief");
    std::uint64_t seen = 0;
    std::unique_lock lock(mutex_);
    for (;;) {
        begun_.wait(lock, [&] { return closed_ || round_ != seen; });
        if (closed_) {
            return;
        }
        seen = round_;
        const Work work = work_;
        const int count = count_;
        lock.unlock();
        take(work, count, thread);
        lock.lock();
        if (--busy_ == 0) {
            done_.notify_one();
        }
    }
}

} // namespace frustumscreen::relief
