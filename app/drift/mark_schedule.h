/// The schedule of the drift marks: a set of all marks, one after the other, now and then while no visitor is
/// present.
///
///     |before|  lit  |after = before|  lit  |after ...
///
/// Time     a parameter, the frames' own; `MarkTimes` gives the times to the consumer of the camera's frames.
/// Threads  pure; one caller.
#pragma once

#include "app/drift/mark_finder.h"
#include "firmware_host/base/time.h"

#include <cstddef>
#include <optional>

namespace frustumscreen::drift {

/// Times within a set, from its start.
struct MarkTimes {
    static constexpr Nanoseconds lead = std::chrono::milliseconds(500);
    static constexpr Nanoseconds each = std::chrono::milliseconds(1000);
    static constexpr Nanoseconds lit = std::chrono::milliseconds(500);
    static constexpr Nanoseconds fade = std::chrono::milliseconds(80); ///< at both ends of `lit`
    /// Delay until a shown mark is surely in the camera's frames: the latency of display and camera.
    static constexpr Nanoseconds settles = std::chrono::milliseconds(200);

    [[nodiscard]] static constexpr Nanoseconds length(std::size_t marks) {
        return lead + static_cast<Nanoseconds::rep>(marks) * each;
    }
    /// The mark and phase of a frame; nullopt: the picture is changing.
    struct Moment {
        std::size_t mark = 0;
        MarkPhase phase = MarkPhase::Before;
    };
    [[nodiscard]] static std::optional<Moment> moment(Nanoseconds since_begin, std::size_t marks);
    /// Brightness of a mark, `since_lit` after its start, 0..1.
    [[nodiscard]] static double brightness(Nanoseconds since_lit);
};

class MarkSchedule {
public:
    static constexpr Nanoseconds between_sets = std::chrono::seconds(60);
    static constexpr Nanoseconds quiet_before = std::chrono::seconds(3); ///< required time without a visitor

    explicit MarkSchedule(std::size_t marks) : marks_(marks) {}

    struct Mark {
        std::size_t mark = 0;
        double brightness = 0.0; ///< above 0, up to 1
    };
    /// `quiet`: no visitor is present, and the table is as usual. Otherwise a current set is cancelled at
    /// once.
    [[nodiscard]] std::optional<Mark> step(MonotonicTime now, bool quiet);
    /// Start of the current or the previous set; nullopt: it was cancelled.
    [[nodiscard]] const std::optional<MonotonicTime>& began() const { return began_; }

private:
    std::size_t marks_;
    std::optional<MonotonicTime> began_;
    std::optional<MonotonicTime> quiet_since_;
    std::optional<MonotonicTime> next_; ///< earliest start of the next set
};

} // namespace frustumscreen::drift
