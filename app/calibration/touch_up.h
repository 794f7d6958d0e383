/// A kept calibration touched up: by three touches or more it is found what moved since, and by how much.
///
/// Method   the projector moved, or the tracker's source: each is one rigid change, six unknowns, with priors of some centimetres and degrees.
///          Each is fitted to the touches at the kept table; the better one counts, if it is significantly better than no change. Only the
///          source's move takes the table along in the tracker's frame, so that the heights of the touches tell the two apart.
/// Frame    the table's: it stays what it was, whatever moved.
/// Units    metres.
/// Threads  pure; any.
#pragma once

#include "app/calibration/calibrate_touch.h"
#include "app/calibration/rigid_move.h"

namespace frustumscreen {

struct TouchUp {
    Verdict verdict = Verdict::Refused;
    std::string reason; ///< one sentence for a technician
    Moved moved = Moved::Nothing;
    std::optional<CalibratedTable> table; ///< the kept one, corrected by what moved; nothing if refused
    double off_m = 0.0;                   ///< how far the picture was off, on average over the zone
    std::vector<TouchResidual> residuals; ///< of each touch, left out; at the kept table where nothing moved
    PictureUncertainty
        uncertainty; ///< of the correction that the touches tell, one standard deviation, also where none is made
    double hidden_error_m = 0.0;        ///< what one wrong touch could do to it and yet agree with the others
    std::vector<PlaceUncertainty> zone; ///< zone_columns x zone_rows of each height, from the table up
};

[[nodiscard]] TouchUp touch_up(const CalibratedTable& kept, std::span<const Touch> touches,
                               const TouchSetup& setup);

} // namespace frustumscreen
