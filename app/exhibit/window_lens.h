/// Through the lens: while it is on, the newest window's content follows the prop. Turning the prop about the vertical turns it;
/// lifting the prop or drawing it near makes it larger, lowering it or pushing it away smaller.
///
/// Ends     after `still` without motion, once the prop has moved; after `waits`, if it has not moved; at any press;
///          without a pose of the prop.
/// Units    metres, radians.
/// Time     `now` never goes back.
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include "app/geometry/transform.h"
#include "firmware_host/base/time.h"

#include <chrono>
#include <optional>

namespace frustumscreen::exhibit {

class WindowLens {
public:
    static constexpr double min_zoom = 0.5, max_zoom = 3.0;
    static constexpr double doubles_m = 0.08; ///< of the prop's way, for twice the size
    static constexpr double follows_s = 0.12; ///< time constant with which the content follows
    static constexpr double still_m = 0.004, still_deg = 2.0; ///< within which the prop counts as still
    static constexpr Nanoseconds still = std::chrono::milliseconds(1500), waits = std::chrono::seconds(6);

    struct View {
        double turn_rad = 0.0; ///< of the artifact, about the prop's axis
        double zoom = 1.0;
    };
    /// Begins from the view that the window has.
    void begin(MonotonicTime now, const View& view, const geometry::RigidTransform& table_from_prop);
    void end() { on_ = false; }
    [[nodiscard]] bool on() const { return on_; }
    /// `quarter_turns`: the reader's side.
    void step(MonotonicTime now, const geometry::RigidTransform& table_from_prop, int quarter_turns);
    [[nodiscard]] const View& view() const { return view_; }

private:
    [[nodiscard]] static double yaw_of(const geometry::RigidTransform& table_from_prop);

    bool on_ = false, has_moved_ = false;
    View first_, view_;
    glm::dvec3 begin_m_{0.0};        ///< of the prop
    double turned_rad_ = 0.0;        ///< since the beginning, also by more than a turn
    double yaw_rad_ = 0.0;           ///< at the latest step
    geometry::RigidTransform rests_; ///< where the prop was when it last counted as moved
    MonotonicTime last_, moved_;
};

} // namespace frustumscreen::exhibit
