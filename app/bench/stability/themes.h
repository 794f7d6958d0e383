/// The cases: one function and one file per theme.
///
/// Threads  pure, any; driver cases: one at a time.
#pragma once

#include "app/bench/stability/stability.h"

namespace frustumscreen::bench {

[[nodiscard]] std::vector<StabilityCase> eye_cases();
[[nodiscard]] std::vector<StabilityCase> two_eyes_cases();
[[nodiscard]] std::vector<StabilityCase> room_cases();
[[nodiscard]] std::vector<StabilityCase> torch_cases();
[[nodiscard]] std::vector<StabilityCase> torch_plan_cases();
[[nodiscard]] std::vector<StabilityCase> window_cases();
[[nodiscard]] std::vector<StabilityCase> site_cases();
[[nodiscard]] std::vector<StabilityCase> prop_cases();
[[nodiscard]] std::vector<StabilityCase> projector_cases();
[[nodiscard]] std::vector<StabilityCase> light_cases();
[[nodiscard]] std::vector<StabilityCase> artifact_cases();
[[nodiscard]] std::vector<StabilityCase> shape_cases();
[[nodiscard]] std::vector<StabilityCase> pose_cases();
[[nodiscard]] std::vector<StabilityCase> time_cases();
[[nodiscard]] std::vector<StabilityCase> smoother_cases();
[[nodiscard]] std::vector<StabilityCase> fade_cases();
[[nodiscard]] std::vector<StabilityCase> estimator_cases();
[[nodiscard]] std::vector<StabilityCase> motion_cases();
[[nodiscard]] std::vector<StabilityCase> governor_cases();
[[nodiscard]] std::vector<StabilityCase> calibration_cases();
[[nodiscard]] std::vector<StabilityCase> layered_depth_cases();
[[nodiscard]] std::vector<StabilityCase> patch_relief_cases();
/// These draw in a context of their own.
[[nodiscard]] std::vector<StabilityCase> driver_cases();

/// Parts of program_step_errors.
[[nodiscard]] std::vector<StepError> frame_time_step_errors();
[[nodiscard]] std::vector<StepError> governor_step_errors();
[[nodiscard]] std::vector<StepError> fade_step_errors();

} // namespace frustumscreen::bench
