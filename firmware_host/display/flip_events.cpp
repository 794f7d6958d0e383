#include "firmware_host/display/flip_events.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>

extern "C" {
#include <xf86drm.h>
}

namespace frustumscreen::display {

FlipEvents::FlipEvents(int card) : card_(card) {
    std::uint64_t monotonic = 0;
    monotonic_ = drmGetCap(card, DRM_CAP_TIMESTAMP_MONOTONIC, &monotonic) == 0 && monotonic == 1;
}

void FlipEvents::expect_of(std::uint32_t crtc) {
    crtc_ = crtc;
    keep_time_.reset();
}

std::optional<Flipped> FlipEvents::wait(Nanoseconds at_most) {
    const MonotonicTime give_up = monotonic_now() + at_most;
    while (true) {
        if (!seen_.empty()) {
            const Flipped first = seen_.front();
            seen_.erase(seen_.begin());
            return first;
        }
        const auto left = std::max(give_up - monotonic_now(), Nanoseconds(0));
        pollfd card{card_, POLLIN, 0};
        const auto left_ms = std::chrono::ceil<std::chrono::milliseconds>(left).count();
        if (::poll(&card, 1, static_cast<int>(left_ms)) <= 0 || (card.revents & POLLIN) == 0 || !read()) {
            return std::nullopt;
        }
    }
}

bool FlipEvents::read() {
    alignas(drm_event_vblank) std::array<char, 1024> bytes; // the kernel returns whole events
    const ssize_t length = ::read(card_, bytes.data(), bytes.size());
    std::size_t at = 0;
    while (length > 0 && at + sizeof(drm_event) <= static_cast<std::size_t>(length)) {
        drm_event event;
        std::memcpy(&event, bytes.data() + at, sizeof event);
        if (event.length < sizeof event || at + event.length > static_cast<std::size_t>(length)) {
            break;
        }
        if (event.type == DRM_EVENT_FLIP_COMPLETE && event.length >= sizeof(drm_event_vblank)) {
            drm_event_vblank flip;
            std::memcpy(&flip, bytes.data() + at, sizeof flip);
            const MonotonicTime time(std::chrono::seconds(flip.tv_sec) +
                                     std::chrono::microseconds(flip.tv_usec));
            if (flip.crtc_id == 0 || flip.crtc_id == crtc_) {
                ask_whether_they_keep_time();
                seen_.push_back({.time = monotonic_ ? time : monotonic_now(),
                                 .ticket = flip.user_data,
                                 .refresh = flip.sequence});
            }
        }
        at += event.length;
    }
    return length > 0;
}

void FlipEvents::ask_whether_they_keep_time() {
    if (keep_time_) {
        return;
    }
    std::uint64_t refresh = 0;
    std::uint64_t at_ns = 0;
    if (drmCrtcGetSequence(card_, crtc_, &refresh, &at_ns) == 0) {
        keep_time_ = monotonic_;
    } else if (errno != EINVAL) {
        keep_time_ = false;
    }
}

} // namespace frustumscreen::display
