/// A touch-up of a kept calibration: three touches or more reveal what has moved since, and by how much.
///
/// Method   The projector moved, or the tracker's source: each is a rigid move, six unknowns, with priors of
///          some centimetres and degrees. Each is fitted to the touches at the kept table. The better one
///          counts if it is significantly better than no move. Only the source's move takes the table along
///          in the tracker's frame, so the touches' heights tell the two apart.
/// Frame    the table's; it stays the same, whatever moved.
/// Units    metres.
/// Threads  pure; any.
#pragma once

#include "app/calibration/calibrate_touch.h"
#include "app/calibration/rigid_move.h"

namespace frustumscreen::calibration {

struct TouchUp {
    Verdict verdict = Verdict::Refused;
    VerdictReason reason;
    Moved moved = Moved::Nothing;
    std::optional<CalibratedTable> table; ///< the kept table, corrected for the move; none if refused
    double off_m = 0.0;                   ///< mean error of the picture over the zone before the correction
    std::vector<TouchResidual>
        residuals;                      ///< of each touch, leave-one-out; at the kept table if nothing moved
    PictureUncertainty uncertainty;     ///< of the correction, one standard deviation; also if none is made
    double hidden_error_m = 0.0;        ///< largest picture error from one wrong touch that goes unnoticed
    std::vector<PlaceUncertainty> zone; ///< zone_columns x zone_rows of each height, from the table up
};

[[nodiscard]] TouchUp touch_up(const CalibratedTable& kept, std::span<const Touch> touches,
                               const TouchSetup& setup);

} // namespace frustumscreen::calibration
