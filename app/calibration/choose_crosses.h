/// Which crosses to touch: those that leave the least uncertainty of the picture over the whole zone.
///
/// Method   I-optimal design (Fedorov, Theory of optimal experiments, 1972): from a grid of pixels, block heights and turns, crosses are
///          exchanged while the mean variance over the zone falls. It needs a rough model alone: what a cross tells hardly depends on where exactly
///          the projector is.
/// Threads  pure; any.
#pragma once

#include "app/calibration/priors.h"
#include "app/calibration/touch.h"
#include "app/calibration/touch_model.h"

#include <span>

namespace frustumscreen {

/// A cross that the projector shows, and how the prop is laid on it.
struct Cross {
    glm::dvec2 pixel{0.0};
    double block_m = 0.0;
    double yaw_rad = 0.0; ///< of the prop, counter-clockwise from above
};

struct CrossSetup {
    int count = 9;
    double block_m = 0.12; ///< the largest height above the table; a few touches may also lie at its thirds
    double margin = 0.03;  ///< how far a cross stays from the picture's edge, in widths
    double top_m = 0.12;   ///< the prop's height
    TouchNoise noise;
    Priors priors;
};

/// A rough model where nothing is known but the picture and the throw: a projector straight above, a tracker in the table's frame.
[[nodiscard]] TouchModel rough_model(const Pinhole& pinhole, double above_m, double sensor_height_m);

/// In the order in which to touch them: from low to high. `rough`: its K is taken as a frame whose Z is up.
[[nodiscard]] std::vector<Cross> choose_crosses(const TouchModel& rough, const CrossSetup& setup);
/// The same for a touch-up, where all is known but how the projector moved; `kept`: as `rough`. The order is that in which they are
/// touched: after the first `setup.count`, `more` that make them check each other.
[[nodiscard]] std::vector<Cross> choose_touch_up_crosses(const TouchModel& kept, const CrossSetup& setup,
                                                         int more);

} // namespace frustumscreen
