/// Chooses an artifact by its object in the room behind the screen: the prop rests in front of the object, seen from the eye.
///
/// The dwell goes on while the prop stays before one object and close to where it was when the dwell began. When it moves on,
/// or something is pressed, nothing is chosen. After a choice, and after a press, the prop must leave that object first.
///
/// Frames   table T, metres.
/// Time     `now` never goes back; the rhythm of frames does not matter, but a gap of half a second restarts the dwell.
/// Threads  values; one caller. Allocates nothing.
/// Errors   none.
#pragma once

#include "firmware_host/base/time.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>

namespace frustumscreen::exhibit {

/// An object of the room that stands for an artifact.
struct RoomObject {
    std::size_t object = 0;   ///< index into room::Room::objects
    std::size_t artifact = 0; ///< index into the catalogue

    [[nodiscard]] bool operator==(const RoomObject&) const = default;
};

class ObjectDwell {
public:
    static constexpr Nanoseconds settles = std::chrono::milliseconds(300); ///< before the object shows it
    static constexpr Nanoseconds lasts = std::chrono::milliseconds(1500);
    static constexpr Nanoseconds longest_gap = std::chrono::milliseconds(500);
    static constexpr double resting_m =
        0.05; ///< larger than on a picture, because a hand holds the prop; from its first place

    struct Input {
        std::optional<RoomObject>
            object; ///< that the prop is in front of; none: it is in front of none, or rests elsewhere
        glm::dvec3 prop_m{0.0};  ///< its middle
        std::size_t in_prop = 0; ///< this artifact is chosen already
        bool choose = false;     ///< pressed: chooses the object that shows it
        bool other_press = false;
    };
    /// Returns the object that is chosen, in that step only.
    [[nodiscard]] std::optional<RoomObject> step(MonotonicTime now, const Input& input);
    /// The object that the prop has settled before, as of the latest step; also in the step that chooses it.
    [[nodiscard]] const std::optional<RoomObject>& settled() const { return settled_; }

private:
    struct Rest {
        RoomObject object;
        MonotonicTime since;
        glm::dvec3 anchor_m{0.0};
    };
    std::optional<Rest> rest_;
    std::optional<std::size_t> done_; ///< the object that the prop must leave first
    std::optional<RoomObject> settled_;
    MonotonicTime last_;
};

} // namespace frustumscreen::exhibit
