/// Measures what each cull kind saves. The same scene is loaded as planned, with everything, and once for each cull
/// kind with that kind alone switched off; then all of them draw the same poses in turn.
///
/// Units    GPU bytes as reported by the driver; RAM bytes that the program has from the allocator after loading (a
///          software GPU keeps its memory there too, so its bytes are counted in both); milliseconds of loading;
///          microseconds of drawing, until the picture is complete.
/// Threads  the render thread, with the display's context current.
/// Errors   as ArtifactShow.
#pragma once

#include "app/scene/device_plan.h"
#include "app/settings/settings.h"
#include "app/show/artifact_show.h"
#include "firmware_host/base/result.h"
#include "firmware_host/display/display.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace frustumscreen::programs {

struct SceneCost {
    std::int64_t gpu_bytes = 0;
    std::int64_t ram_bytes = 0;
    double load_ms = 0.0;
    double frame_us = 0.0;  ///< median; for a saving, the median of differences at the same pose
    double spread_us = 0.0; ///< for a saving: half the distance between the quartiles of the differences
};

struct CullSaving {
    scene::CullKind cull_kind = scene::UnusedLevels;
    SceneCost saved;
};

struct PlanMeasurement {
    std::unique_ptr<show::ArtifactShow> show; ///< as planned
    SceneCost everything, planned, saved;
    std::vector<CullSaving> cull_kinds; ///< those that leave something out
    std::size_t poses = 0;
    std::string renderer; ///< the driver's name for the GPU
};

[[nodiscard]] Result<PlanMeasurement> measure_plan(const settings::Settings& settings,
                                                   const scene::DevicePlan& devices,
                                                   const std::filesystem::path& pack,
                                                   const std::string& technique, display::Display& display);

} // namespace frustumscreen::programs
