/// When which mark of light is shown: a set of all marks, one after the other, now and then while nobody is there.
///
///     |before|  lit  |after = before|  lit  |after ...
///
/// Time     a parameter, the frames' own; `MarkTimes` says it to whoever sees the frames of the camera.
/// Threads  pure; one caller.
#pragma once

#include "app/drift/mark_finder.h"
#include "firmware_host/base/time.h"

#include <cstddef>
#include <optional>

namespace frustumscreen {

/// Within a set, from its beginning.
struct MarkTimes {
    static constexpr Nanoseconds lead = std::chrono::milliseconds(500);
    static constexpr Nanoseconds each = std::chrono::milliseconds(1000);
    static constexpr Nanoseconds lit = std::chrono::milliseconds(500);
    static constexpr Nanoseconds fade = std::chrono::milliseconds(80); ///< at both ends of it
    /// Until what is shown is surely seen: the display's and the camera's own time.
    static constexpr Nanoseconds settles = std::chrono::milliseconds(200);

    [[nodiscard]] static constexpr Nanoseconds length(std::size_t marks) {
        return lead + static_cast<Nanoseconds::rep>(marks) * each;
    }
    /// Which mark a frame tells of; nothing: what it shows is changing.
    struct Moment {
        std::size_t mark = 0;
        MarkPhase phase = MarkPhase::Before;
    };
    [[nodiscard]] static std::optional<Moment> moment(Nanoseconds since_begin, std::size_t marks);
    /// Light of a mark that is shown since so long, 0..1.
    [[nodiscard]] static double brightness(Nanoseconds since_lit);
};

class MarkSchedule {
public:
    static constexpr Nanoseconds between_sets = std::chrono::seconds(60);
    static constexpr Nanoseconds quiet_before = std::chrono::seconds(3); ///< nobody was there for so long

    explicit MarkSchedule(std::size_t marks) : marks_(marks) {}

    struct Mark {
        std::size_t mark = 0;
        double brightness = 0.0; ///< above 0, up to 1
    };
    /// `quiet`: nobody is there, and the table is as usual; else a set that goes on is given up at once.
    [[nodiscard]] std::optional<Mark> step(MonotonicTime now, bool quiet);
    /// When the set began that goes on, or the one before; nothing: it was given up.
    [[nodiscard]] const std::optional<MonotonicTime>& began() const { return began_; }

private:
    std::size_t marks_;
    std::optional<MonotonicTime> began_;
    std::optional<MonotonicTime> quiet_since_;
    std::optional<MonotonicTime> next_; ///< not before
};

} // namespace frustumscreen
