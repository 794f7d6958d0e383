/// The tracked state: the pose of the prop and the position of the visitor's eye at one time.
///
/// Frames   table T, metres; samples too (registered_tracker.h).
/// Time     a sample takes effect at its own time; `at(now)` asks for any later time.
/// Threads  values; one caller.
#pragma once

#include "app/geometry/transform.h"
#include "firmware_host/tracker/tracker.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace frustumscreen::tracking {

/// Whether a torch gives light, which comes and goes softly.
enum class TorchPresence : std::uint8_t {
    Lost,   ///< its place is not known
    Lies,   ///< it was laid down, or hangs in its holder
    InHand, ///< it shines
};

/// A hand-held torch. Its frame: torch.h.
struct TrackedTorch {
    geometry::RigidTransform table_from_torch;
    double share = 0.0; ///< 0..1 of its light; 0: it is not known, or lies
    TorchPresence presence = TorchPresence::Lost;
};
inline constexpr std::size_t max_tracked_torches = 2; ///< at the tracker, and one that a camera sees

struct TrackedState {
    geometry::RigidTransform table_from_prop;
    glm::dvec3 eye_m{0.0}; ///< between the visitor's eyes
    /// Turns the head's frame into the table's: +x to the head's right, +Y ahead, +Z up.
    glm::dquat table_from_head{1.0, 0.0, 0.0, 0.0};
    /// Share of the interocular distance that the picture shows, 0..1; 0: one eye. Below 1 while the turn of the head
    /// is not known, or nobody wears the sensor.
    double eyes_apart = 0.0;
    MonotonicTime time;      ///< time of this state
    bool prop_known = false; ///< a usable pose of the prop was seen and is not too old
    bool head_known = false; ///< from a sensor on the visitor's head
    bool head_seen =
        false; ///< eye from a camera; if neither, `eye_m` is the default eye, or easing towards it
    double eye_sd_m = 0.0; ///< of a seen head: error of `eye_m` across its line to the prop, RMS on each axis
    Nanoseconds prop_age{0}; ///< of the pose used
    tracker::TrackerHealth tracker = tracker::TrackerHealth::Well;
    bool by_tags = false; ///< `table_from_prop` is from the tags
    std::array<TrackedTorch, max_tracked_torches> torches{};

    [[nodiscard]] bool eye_known() const { return head_known || head_seen; }
};

/// The left and the right eye, table frame: half of the interocular distance to either side along the head's x axis.
[[nodiscard]] std::array<glm::dvec3, 2> eyes_of(const TrackedState& state, double interocular_m);

struct TrackedStateLimits {
    Nanoseconds oldest_prop = std::chrono::seconds(1);
    Nanoseconds oldest_head = std::chrono::seconds(1);
    Nanoseconds oldest_torch = std::chrono::milliseconds(250);
};

class TrackedStateTracker {
public:
    explicit TrackedStateTracker(const glm::dvec3& default_eye_m, const TrackedStateLimits& limits = {});

    /// Samples with ok = false, of other stations, or older than the last one of their station are ignored.
    /// Rotations are normalised. Returns false for a sample that claims to be usable but is not a pose (not
    /// finite, or a zero quaternion); it is ignored too.
    bool take(const tracker::PoseSample& sample);
    /// The latest pose, neither filtered nor predicted.
    [[nodiscard]] TrackedState at(MonotonicTime now) const;

private:
    struct Latest {
        geometry::RigidTransform table_from_station;
        MonotonicTime time;
    };

    glm::dvec3 default_eye_m_;
    TrackedStateLimits limits_;
    std::optional<Latest> prop_;
    std::optional<Latest> head_;
    std::optional<Latest> torch_;
};

} // namespace frustumscreen::tracking
