/// The expected time of a frame that shows an artifact whole or in cells, before anything of it was drawn: what a bake
/// decides by whether cells pay.
///
/// Model    a time for the picture, more for each triangle or block of the quickest way to draw each part that is good
///          enough (within_tolerance), more for each part beyond the first. Samples of pixels are the same whole or in cells.
/// Units    times of the floor (docs/conventions.md) in the near set-up, so that the processor does not matter.
/// Source   of the constants: `frustumscreen-bench cells --config config/near.toml` with the chess board, two cores, llvmpipe.
/// Threads  pure; any.
/// Errors   a pack's section that violates FORMAT.md.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/pack/pack_outline.h"
#include "app/scene/governor.h"
#include "firmware_host/base/result.h"

#include <span>
#include <string>

namespace frustumscreen::scene {

struct PartCosts {
    double picture = 0.0;
    double per_triangle = 0.0;
    double per_block = 0.0;
    double per_part = 0.0;
};
inline constexpr PartCosts usual_part_costs{
    .picture = 2.3, .per_triangle = 1.1e-4, .per_block = 1.5e-4, .per_part = 0.05};

/// The way to draw a part, and its share of a frame without `picture` and `per_part`.
struct PartWay {
    QualityLevel way;
    double cost = 0.0;
};

/// Of all levels and reliefs that are good enough the quickest; if none is, the finest level.
[[nodiscard]] Result<PartWay> quickest_way(const pack::PackOutline& part, double mm_per_box,
                                           double tolerance_mm, const PartCosts& costs = usual_part_costs);
[[nodiscard]] double frame_cost(std::span<const PartWay> parts, const PartCosts& costs = usual_part_costs);

/// Half a pixel of the near set-up (config/near.toml) on its prop, millimetres.
inline constexpr double near_tolerance_mm = 0.137;

/// False if the cells do not save at least a tenth.
[[nodiscard]] bool cells_pay(double whole, double in_cells);

} // namespace frustumscreen::scene
