#include "firmware_host/service/watchdog_policy.h"

#include <algorithm>

namespace frustumscreen::service {

std::string_view sentence_of(Health health) {
    switch (health) {
    case Health::Well:
        return "pictures are presented and change";
    case Health::NoPicture:
        return "no picture is presented any more";
    case Health::FrozenCode:
        return "the picture that is presented is not the one that was drawn";
    case Health::ThreadHangs:
        return "a device's thread hangs";
    case Health::Hangs:
        return "the exhibit's own thread hangs";
    }
    return "";
}

std::string_view word_of(Health health) {
    switch (health) {
    case Health::Well:
        return "well";
    case Health::NoPicture:
        return "no_picture";
    case Health::FrozenCode:
        return "frozen";
    case Health::ThreadHangs:
        return "thread_hangs";
    case Health::Hangs:
        return "hangs";
    }
    return "";
}

WatchdogPolicy::WatchdogPolicy(Nanoseconds interval, MonotonicTime start)
    : feed_every_(std::min<Nanoseconds>(interval / 3, std::chrono::seconds(1))), presented_(start),
      changed_(start) {}

void WatchdogPolicy::read_back(MonotonicTime now, const ProbeReading& read) {
    const bool another = read.code && read.code != code_;
    if (read.code) {
        code_ = read.code;
    }
    if (read.covered || another) {
        changed_ = now;
    }
}

Health WatchdogPolicy::health(MonotonicTime now, std::span<const MonotonicTime> promises) const {
    if (now - presented_ > picture_within) {
        return Health::NoPicture;
    }
    if (now - changed_ > picture_within) {
        return Health::FrozenCode;
    }
    const bool broken =
        std::any_of(promises.begin(), promises.end(), [now](MonotonicTime until) { return now > until; });
    return broken ? Health::ThreadHangs : Health::Well;
}

bool WatchdogPolicy::feed(MonotonicTime now, Health health) {
    if (health != Health::Well || (fed_ && now - *fed_ < feed_every_)) {
        return false;
    }
    fed_ = now;
    return true;
}

} // namespace frustumscreen::service
