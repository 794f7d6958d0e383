/// Chooses the crosses that leave the least uncertainty of the picture over the whole zone.
///
/// Method   I-optimal design (Fedorov, Theory of optimal experiments, 1972): crosses from a grid of pixels,
///          block heights and turns are exchanged while the mean variance over the zone falls. A rough model
///          is enough: the information of a cross hardly depends on the projector's exact position.
/// Reach    The prop stands on the table, or on boards that stand on it, so its middle stays half its width
///          away from the table's edges. If a table has no space for that, the crosses still spread over a
///          tenth of the picture's width, and the prop hangs over the edge.
/// Threads  pure; any.
#pragma once

#include "app/calibration/priors.h"
#include "app/calibration/touch.h"
#include "app/calibration/touch_model.h"

#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::calibration {

/// A cross that the projector shows, and how the prop is laid on it.
struct Cross {
    glm::dvec2 pixel{0.0};
    double block_m = 0.0;
    double yaw_rad = 0.0; ///< of the prop, counter-clockwise from above
};

struct CrossSetup {
    int count = 9;
    double block_m = 0.12; ///< the largest height above the table; a few touches may also be at its thirds
    double margin = 0.03;  ///< distance of a cross from the picture's edge, in picture widths
    double top_m = 0.12;   ///< the prop's height
    /// Half the width and depth of the area, centred on the frame's origin, for the middle of the prop's
    /// bottom, so that the prop stands on the table. None: the whole picture.
    std::optional<glm::dvec2> reach_m;
    TouchNoise noise;
    Priors priors;
};

/// Margin of the table that stays visible around prop and boards; a cross's arms end in it. Boards are wider
/// than the prop by this margin.
inline constexpr double stand_margin_m = 0.005;
/// Half the width and depth of the area in which the middle of a prop may lie; negative if the prop is too
/// large for the table.
[[nodiscard]] glm::dvec2 reach_of(const glm::dvec2& table_m, double prop_base_m);
/// The least side length of a stack of boards.
[[nodiscard]] constexpr double boards_side_m(double prop_base_m) {
    return prop_base_m + 2.0 * stand_margin_m;
}
/// The largest overhang of boards, or of a prop with its margin, over the table's edge at any cross; 0 if
/// there is none.
[[nodiscard]] double overhang_m(const TouchModel& rough, std::span<const Cross> crosses,
                                const glm::dvec2& reach_m);

/// A rough model from the picture and the throw alone: a projector straight above, a tracker in the table's
/// frame.
[[nodiscard]] TouchModel rough_model(const geometry::Pinhole& pinhole, double above_m,
                                     double sensor_height_m);

/// The first `setup.count` crosses in the order in which to touch them, from low to high; after them `more`, the
/// best to add to these, also from low to high. `rough`: its frame K must have Z up.
[[nodiscard]] std::vector<Cross> choose_crosses(const TouchModel& rough, const CrossSetup& setup,
                                                int more = 0);
/// The same for a touch-up, where only the projector's move is unknown; `kept`: as `rough`. The crosses of `more`
/// let the touches check each other.
[[nodiscard]] std::vector<Cross> choose_touch_up_crosses(const TouchModel& kept, const CrossSetup& setup,
                                                         int more);

} // namespace frustumscreen::calibration
