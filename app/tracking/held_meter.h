/// Whether the prop is held in a hand: on a table nothing lifts or tilts it, a hand does both all the time.
///
/// Measure  the scatter of the prop's height and of the table's up direction seen from the prop, over the last tenth of a
///          second, compared with the tracker's noise. A prop that stands, slides or turns on the table has noise alone,
///          whichever of its faces it stands on.
/// Frame    poses in the table's.
/// Soft     the share goes from 0 to 1 in a tenth of a second or longer, and is 0 exactly while nothing lifts or tilts the prop.
/// Time     steps above 0; the decay is exact over a step of any length.
/// Threads  a value; one caller. Allocates nothing.
#pragma once

#include "app/geometry/transform.h"
#include "app/tracking/pose_noise.h"

namespace frustumscreen::tracking {

class HeldMeter {
public:
    /// `lever_m`: half the prop's size.
    explicit HeldMeter(const PoseNoise& noise = {}, double lever_m = 0.06);

    void restart(const geometry::RigidTransform& measured);
    void take(const geometry::RigidTransform& measured, double dt_s);
    /// 0: it stands, slides or turns on the table; 1: it is held.
    [[nodiscard]] double share() const { return share_; }

private:
    double noise_m_;
    double lever_m_;
    double mean_height_m_ = 0.0;
    glm::dvec3 mean_up_{0.0};
    double scatter_m2_ = 0.0;
    double share_ = 0.0;
};

} // namespace frustumscreen::tracking
