/// Decides when the service manager's watchdog is fed: only while the projector's picture lives.
///
/// Fed      while pictures (at rest: the probe, once a second) are presented on time, the reserved code that
///          is read back from them changes each time, and every device thread keeps its promise.
/// Asleep   a projector that is dark on purpose shows no picture; the promises count all the same.
/// Lost     a lost device does not stop the feeding: its thread lives and says so, and the exhibit goes on.
/// Time     a parameter, monotonic.
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include "firmware_host/base/time.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace frustumscreen {

enum class Health : std::uint8_t {
    Well,
    NoPicture,   ///< nothing was presented for too long
    FrozenCode,  ///< what was presented does not change, or has no code
    ThreadHangs, ///< a device's thread broke its promise
    Hangs,       ///< the exhibit's own thread is silent; another one reports it (hang_watch.h)
};
/// What is wrong, in one sentence; Well has one too.
[[nodiscard]] std::string_view sentence_of(Health health);
/// The same in one word, for another program: well, no_picture, frozen, thread_hangs, hangs.
[[nodiscard]] std::string_view word_of(Health health);

/// What was read back from a picture that was presented.
struct ProbeReading {
    bool covered = false;             ///< the picture lights the corner: there is no code
    std::optional<std::uint8_t> code; ///< nothing = the corner holds something else
};

class WatchdogPolicy {
public:
    /// Three and a half rests between probes: a flip that comes late shows the same code once more.
    static constexpr Nanoseconds picture_within = std::chrono::milliseconds(3500);

    /// `interval` is the service manager's. It is fed three times in each, and at least once a second.
    WatchdogPolicy(Nanoseconds interval, MonotonicTime start);

    /// A picture was presented.
    void presented(MonotonicTime now) { presented_ = now; }
    /// The projector is dark on purpose: the next picture is due within `picture_within` of the latest call.
    void asleep(MonotonicTime now) { presented_ = changed_ = now; }
    /// Whether the next picture's code is worth reading back: not in every frame.
    [[nodiscard]] bool wants_code(MonotonicTime now) const { return now - changed_ >= feed_every_ / 2; }
    void read_back(MonotonicTime now, const ProbeReading& read);

    /// `promises`: until when each device thread has promised to be heard from again.
    [[nodiscard]] Health health(MonotonicTime now, std::span<const MonotonicTime> promises) const;
    /// True: feed it now.
    [[nodiscard]] bool feed(MonotonicTime now, Health health);

private:
    Nanoseconds feed_every_;
    MonotonicTime presented_;
    MonotonicTime changed_; ///< when a picture with another code was last seen
    std::optional<std::uint8_t> code_;
    std::optional<MonotonicTime> fed_;
};

} // namespace frustumscreen
