/// What came of a technician's touches, in words for the table and as the way through them needs it.
///
/// Threads  pure; any.
#pragma once

#include "app/calibration/touch_procedure.h"
#include "app/calibration/touch_up.h"

namespace frustumscreen {

[[nodiscard]] TouchJudgement judgement_of(const TouchCalibration& calibration);
[[nodiscard]] TouchJudgement judgement_of(const TouchUp& found);

} // namespace frustumscreen
