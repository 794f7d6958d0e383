/// The cost of a picture of the room: of polygons, which the GPU draws, and of reliefs, which this program rasterizes.
///
/// Units    milliseconds of wall time, of a whole picture at two samples a pixel.
/// Threads  the render thread, with the display's context current.
/// Errors   as read_quality_level; a driver without memory.
#pragma once

#include "app/render/renderer.h"
#include "app/residency/known_model.h"
#include "app/scene/flat_screen.h"
#include "app/scene/frame_time_model.h"
#include "firmware_host/base/result.h"

#include <cstddef>

namespace frustumscreen::show {

/// Costs on a software driver on two cores. Pictures that are not live use these, so that they do not depend on the machine.
inline constexpr scene::FrameCost usual_room_cost{
    .mesh = {.fixed_ms = 8.0, .ms_per_triangle = 5e-5, .ms_per_sample = 2e-5},
    .raster = {.fixed_ms = 2.0, .ms_per_triangle = 4e-5, .ms_per_sample = 2e-5},
    .on_gpu = {}};

/// Draws some of the model's levels and reliefs in front of the screen, into a picture of its own, for up to a
/// second.
[[nodiscard]] Result<scene::FrameCost> measure_room_cost(const residency::KnownModel& model,
                                                         const scene::FlatScreen& screen, int samples,
                                                         render::Renderer& renderer);

} // namespace frustumscreen::show
