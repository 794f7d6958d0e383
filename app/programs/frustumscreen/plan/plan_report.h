/// The plan in words that can be read aloud, and as JSON.
///
/// Threads  pure; any.
#pragma once

#include "app/programs/frustumscreen/plan/plan_measure.h"
#include "app/scene/device_plan.h"

#include <string>

namespace frustumscreen::programs {

struct PlanReport {
    std::string config, pack, technique;
    const scene::DevicePlan& devices;
    const PlanMeasurement& measured;
};
[[nodiscard]] std::string plan_text(const PlanReport& report);
[[nodiscard]] std::string plan_json(const PlanReport& report);

} // namespace frustumscreen::programs
