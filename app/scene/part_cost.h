/// The expected time of a frame that shows an artifact whole or in cells, before anything of it was drawn. A bake decides by it
/// whether cells pay.
///
/// Model    a time for the picture of meshes, which the GPU draws, and one for that of reliefs, which this program rasterizes;
///          more for each triangle or block of the quickest way to draw each part that is good enough (within_tolerance), and
///          for each part beyond the first. A frame with both kinds pays for both pictures: it is chosen only if it saves
///          more than that.
/// Units    times of the floor (docs/conventions.md) in the near set-up, so that the processor does not matter.
/// Source   of the constants: of the chess board's levels and reliefs in docs/measurements.md (near), and the share of the
///          picture in the time of its levels by `frustumscreen-bench cells`; two cores, llvmpipe.
/// Threads  pure; any.
/// Errors   a pack's section that violates FORMAT.md.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/pack/pack_outline.h"
#include "app/scene/governor.h"
#include "firmware_host/base/result.h"

#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::scene {

struct PartCosts {
    double mesh_picture = 0.0;
    double relief_picture = 0.0;
    double per_triangle = 0.0;
    double per_block = 0.0;
    double per_part = 0.0;
};
inline constexpr PartCosts usual_part_costs{.mesh_picture = 3.4,
                                            .relief_picture = 2.3,
                                            .per_triangle = 8.2e-5,
                                            .per_block = 1.5e-4,
                                            .per_part = 0.05};

/// A way to draw a part, and its time without `..._picture` and `per_part`.
struct PartWay {
    QualityLevel way;
    double cost = 0.0;
};
/// The quickest of each kind that is good enough.
struct PartWays {
    PartWay mesh; ///< if no level is good enough, the finest
    std::optional<PartWay> relief;
};
[[nodiscard]] Result<PartWays> good_ways(const pack::PackOutline& part, double mm_per_box,
                                         double tolerance_mm, const PartCosts& costs = usual_part_costs);

/// The quickest frame.
struct PartFrame {
    double cost = 0.0;
    std::vector<PartWay> ways; ///< of each part
};
[[nodiscard]] PartFrame quickest_frame(std::span<const PartWays> parts,
                                       const PartCosts& costs = usual_part_costs);

/// Half a pixel of the near set-up (config/near.toml) on its prop, millimetres.
inline constexpr double near_tolerance_mm = 0.137;

/// False if the cells do not save at least a tenth.
[[nodiscard]] bool cells_pay(double whole, double in_cells);

} // namespace frustumscreen::scene
