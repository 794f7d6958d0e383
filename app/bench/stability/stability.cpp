#include "app/bench/stability/stability.h"

#include "app/bench/stability/themes.h"

#include <cfenv>

namespace frustumscreen::bench {

std::vector<StabilityCase> stability_cases() {
    std::vector<StabilityCase> cases;
    for (const auto& theme :
         {eye_cases,           two_eyes_cases,     room_cases,   window_cases,    site_cases,
          torch_cases,         torch_plan_cases,   prop_cases,   projector_cases, light_cases,
          artifact_cases,      shape_cases,        pose_cases,   time_cases,      smoother_cases,
          estimator_cases,     fade_cases,         motion_cases, governor_cases,  calibration_cases,
          layered_depth_cases, patch_relief_cases, driver_cases}) {
        for (StabilityCase& one : theme()) {
            cases.push_back(std::move(one));
        }
    }
    return cases;
}

StabilityResult measure(const StabilityCase& which, const StabilityOptions& options) {
    std::feclearexcept(FE_ALL_EXCEPT);
    StabilityResult result = which.measure(options);
    if (which.arithmetic == FloatingPoint::Strict) {
        double raised = 0.0;
        for (const int kind : {FE_INVALID, FE_DIVBYZERO, FE_OVERFLOW}) {
            raised += std::fetestexcept(kind) != 0 ? 1.0 : 0.0;
        }
        const StabilityRow row{"kinds of floating-point exceptions raised", 0.0, raised};
        result.rows.push_back(row); // copied: for a move, g++ 12 falsely warns that the string's end is out
                                    // of bounds
    }
    return result;
}

std::vector<StepError> program_step_errors() {
    std::vector<StepError> errors;
    for (const auto& part : {frame_time_step_errors, governor_step_errors, fade_step_errors}) {
        for (StepError& error : part()) {
            errors.push_back(std::move(error));
        }
    }
    return errors;
}

} // namespace frustumscreen::bench
