#include "firmware_host/service/hang_watch.h"

#include "firmware_host/base/device_thread.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::service {

HangPolicy::News HangPolicy::look(MonotonicTime now, MonotonicTime heard) {
    const bool stood_still = !looked_ || now - *looked_ > 2 * between_looks();
    looked_ = now;
    if (hung_) {
        if (heard == *hung_) {
            return News::None;
        }
        hung_.reset();
        return News::HeardAgain;
    }
    watched_since_ = stood_still ? now : watched_since_;
    if (now - std::max(heard, watched_since_) < timeout_) {
        return News::None;
    }
    hung_ = heard;
    return News::Hangs;
}

HangWatch::HangWatch(Nanoseconds timeout, Tell tell)
    : policy_(timeout), tell_(std::move(tell)), heard_(monotonic_now().time_since_epoch().count()),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void HangWatch::enters(const char* doing) {
    doing_ = doing;
    heard_ = monotonic_now().time_since_epoch().count();
}

void HangWatch::run(const std::stop_token& stop) {
    begin_device_thread("hang watch");
    while (!stop.stop_requested()) {
        switch (policy_.look(monotonic_now(), MonotonicTime(Nanoseconds(heard_.load())))) {
        case HangPolicy::News::None:
            break;
        case HangPolicy::News::Hangs:
            tell_(doing_.load());
            break;
        case HangPolicy::News::HeardAgain:
            tell_(std::nullopt);
            break;
        }
        sleep_until_stop(stop, policy_.between_looks());
    }
}

} // namespace frustumscreen::service
