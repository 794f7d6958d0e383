/// What came of a technician's touches, in words for the table and as the way through them needs it.
///
/// Threads  pure; any.
#pragma once

#include "app/calibration/touch_procedure.h"
#include "app/calibration/touch_up.h"

#include <string>

namespace frustumscreen {

[[nodiscard]] TouchJudgement judgement_of(const TouchCalibration& calibration);
[[nodiscard]] TouchJudgement judgement_of(const TouchUp& found);

/// A reason is half a sentence, as programs say it behind a colon: this makes a whole one.
[[nodiscard]] std::string as_sentence(std::string reason);

} // namespace frustumscreen
