/// Decides when to feed the service manager's watchdog: only while the projector's picture is alive.
///
/// Fed      while pictures (at rest: the probe, once a second) are presented on time, the probe code that is
///          read back from them changes each time, and every device thread keeps its promise.
/// Asleep   a projector that is dark on purpose shows no picture; only the promises count.
/// Lost     a lost device does not stop the feeding: its thread is alive and reports the loss, and the
///          exhibit continues.
/// Time     a parameter, monotonic.
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include "firmware_host/base/time.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace frustumscreen::service {

enum class Health : std::uint8_t {
    Well,
    NoPicture,   ///< nothing was presented for too long
    FrozenCode,  ///< the presented picture does not change, or has no code
    ThreadHangs, ///< a device's thread missed its promised time
    Hangs,       ///< the exhibit's own thread is silent; hang_watch.h reports it
};
/// The fault in one sentence; Well has one too.
[[nodiscard]] std::string_view sentence_of(Health health);
/// The health as one word for other programs: well, no_picture, frozen, thread_hangs, hangs.
[[nodiscard]] std::string_view word_of(Health health);

/// The code read back from a presented picture.
struct ProbeReading {
    bool covered = false;             ///< the picture covers the corner, so there is no code
    std::optional<std::uint8_t> code; ///< nullopt = the corner holds something else
};

class WatchdogPolicy {
public:
    /// Three and a half probe intervals at rest: a late flip shows the old code once more.
    static constexpr Nanoseconds picture_within = std::chrono::milliseconds(3500);

    /// `interval` is the service manager's. The watchdog is fed three times per interval, and at least once a
    /// second.
    WatchdogPolicy(Nanoseconds interval, MonotonicTime start);

    /// A picture was presented.
    void presented(MonotonicTime now) { presented_ = now; }
    /// The projector is dark on purpose: the next picture is due `picture_within` after the latest call.
    void asleep(MonotonicTime now) { presented_ = changed_ = now; }
    /// Whether to read back the next picture's code; not needed in every frame.
    [[nodiscard]] bool wants_code(MonotonicTime now) const { return now - changed_ >= feed_every_ / 2; }
    void read_back(MonotonicTime now, const ProbeReading& read);

    /// `promises`: the time until which each device thread has promised a sign of life.
    [[nodiscard]] Health health(MonotonicTime now, std::span<const MonotonicTime> promises) const;
    /// Returns true if the watchdog must be fed now.
    [[nodiscard]] bool feed(MonotonicTime now, Health health);

private:
    Nanoseconds feed_every_;
    MonotonicTime presented_;
    MonotonicTime changed_; ///< when a picture with another code was last seen
    std::optional<std::uint8_t> code_;
    std::optional<MonotonicTime> fed_;
};

} // namespace frustumscreen::service
