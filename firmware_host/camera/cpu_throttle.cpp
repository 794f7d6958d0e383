#include "firmware_host/camera/cpu_throttle.h"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace frustumscreen::camera {

namespace {

constexpr Nanoseconds longest_pause = std::chrono::seconds(10);

} // namespace

double thread_seconds() {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

bool CpuThrottle::begin(MonotonicTime frame) {
    if (next_ && frame < *next_ && *next_ - frame < longest_pause) {
        return false;
    }
    frame_ = frame;
    began_s_ = busy_();
    return true;
}

double CpuThrottle::end() {
    const double took_s = std::fmax(0.0, busy_() - began_s_);
    const MonotonicTime owed_from = next_ && *next_ < frame_ ? std::max(*next_, frame_ - max_credit) : frame_;
    next_ = owed_from + Nanoseconds(std::llround(1e9 * took_s / max_share_));
    return took_s;
}

} // namespace frustumscreen::camera
