/// The change to another set of artifacts: when everything of this set fades out.
///
/// Time     `now` never goes back; the fade is a closed form of it.
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include "firmware_host/base/time.h"

#include <chrono>
#include <cstdint>
#include <optional>

namespace frustumscreen::exhibit {

class SetChange {
public:
    /// How long another set waits for a visitor who is being told something.
    static constexpr Nanoseconds longest_wait = std::chrono::seconds(20);

    enum class Moment : std::uint8_t {
        Fits,  ///< no visitor is disturbed
        Busy,  ///< a visitor is told something, or chooses: the set waits for at most longest_wait
        NotYet ///< something else has to end first
    };

    /// Announces another set; `ready`: it can be shown.
    void await(bool ready) { ready_ = ready; }
    /// Withdraws the announced set.
    void await_none() {
        ready_ = false;
        waits_since_.reset();
    }
    void step(MonotonicTime now, Moment moment);
    /// True if everything of this set fades out or is dark.
    [[nodiscard]] bool leaves() const { return leaves_since_.has_value(); }
    /// True if everything of this set is dark; it stays dark.
    [[nodiscard]] bool has_left() const { return left_; }
    /// Brightness of the whole set: 0..1, a factor on linear light.
    [[nodiscard]] double share(MonotonicTime now) const;

private:
    bool ready_ = false;
    bool left_ = false;
    std::optional<MonotonicTime> waits_since_;
    std::optional<MonotonicTime> leaves_since_;
};

} // namespace frustumscreen::exhibit
