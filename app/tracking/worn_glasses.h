/// Tells whether somebody wears the glasses that carry the head's sensor, or the glasses lie on the table.
///
/// Worn     a living head is never still: it sways, breathes and nods by millimetres. Glasses lie if the smoothed pose
///          of their sensor has stayed within `still_m` of one place for `still_for`; they are worn again from the
///          first pose beyond that. The glasses of a sensor with more noise than that count as worn.
/// Frame    any that does not move; metres.
/// Time     of the poses; a decreasing time counts as none. The rhythm of the poses does not matter.
/// Threads  a value; one caller. Allocates nothing.
#pragma once

#include "app/geometry/transform.h"
#include "firmware_host/base/time.h"

#include <optional>

namespace frustumscreen::tracking {

class WornGlasses {
public:
    static constexpr Nanoseconds still_for = std::chrono::seconds(6);
    /// A follower of this time constant calms the tracker's noise, and is moved by 1 mm soon after a hand takes the
    /// glasses.
    static constexpr Nanoseconds calm_within = std::chrono::milliseconds(500);
    /// Movement of a point `lever_m` from the sensor: shift plus turn.
    static constexpr double still_m = 0.001;
    static constexpr double lever_m = 0.1;

    /// `table_from_sensor`: as the tracker reports it.
    [[nodiscard]] bool worn(MonotonicTime time, const geometry::RigidTransform& table_from_sensor);
    /// Forgets all poses, because the sensor is lost.
    void forget() { calm_.reset(); }

private:
    struct Calm {
        geometry::RigidTransform table_from_sensor;
        MonotonicTime time;
    };
    std::optional<Calm> calm_; ///< nothing: no pose since the sensor was lost
    Calm rested_;              ///< at the latest movement
};

} // namespace frustumscreen::tracking
