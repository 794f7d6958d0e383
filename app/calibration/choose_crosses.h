/// Which crosses to touch: those that leave the least uncertainty of the picture over the whole zone.
///
/// Method   I-optimal design (Fedorov, Theory of optimal experiments, 1972): from a grid of pixels, block heights and turns, crosses are
///          exchanged while the mean variance over the zone falls. It needs a rough model alone: what a cross tells hardly depends on where exactly
///          the projector is.
/// Reach    the prop stands on the table, or on boards that stand there: so its middle stays half its width away from the table's edges. Where
///          a table has no room for that, crosses spread over a tenth of the picture's width all the same, and the prop hangs over.
/// Threads  pure; any.
#pragma once

#include "app/calibration/priors.h"
#include "app/calibration/touch.h"
#include "app/calibration/touch_model.h"

#include <optional>
#include <span>
#include <vector>

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
    /// Half the width and depth, about the frame's origin, of where the middle of the prop's bottom may lie: so that the prop stands on the
    /// table. None: all over the picture.
    std::optional<glm::dvec2> reach_m;
    TouchNoise noise;
    Priors priors;
};

/// Around prop and boards so much of the table is left: the arms of a cross end there. Boards are as much wider than the prop.
inline constexpr double stand_margin_m = 0.005;
/// Where the middle of a prop may lie that stands on a table; below 0: it is too large for that.
[[nodiscard]] glm::dvec2 reach_of(const glm::dvec2& table_m, double prop_base_m);
/// The sides of a stack of boards, at least.
[[nodiscard]] constexpr double boards_side_m(double prop_base_m) {
    return prop_base_m + 2.0 * stand_margin_m;
}
/// How far boards, or a prop with its margin, stand over the table's edge at the worst of the crosses; 0: at none.
[[nodiscard]] double overhang_m(const TouchModel& rough, std::span<const Cross> crosses,
                                const glm::dvec2& reach_m);

/// A rough model where nothing is known but the picture and the throw: a projector straight above, a tracker in the table's frame.
[[nodiscard]] TouchModel rough_model(const Pinhole& pinhole, double above_m, double sensor_height_m);

/// The first `setup.count` crosses in the order in which to touch them, from low to high; after them `more`, the best to add to
/// these, also from low to high. `rough`: its K is taken as a frame whose Z is up.
[[nodiscard]] std::vector<Cross> choose_crosses(const TouchModel& rough, const CrossSetup& setup,
                                                int more = 0);
/// The same for a touch-up, where all is known but how the projector moved; `kept`: as `rough`.
[[nodiscard]] std::vector<Cross> choose_touch_up_crosses(const TouchModel& kept, const CrossSetup& setup,
                                                         int more);

} // namespace frustumscreen
