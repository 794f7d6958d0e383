/// A torch that sweeps over the artifact while prop and eye move: seeded, continuous, the same on every machine.
///
/// Frames   table frame, metres. The torch looks at a place in the artifact's box, from 3 to 13 cm before that box, on any
///          side and above; it turns about its own axis too.
/// Threads  pure; any.
/// Errors   as draw_walk.
#pragma once

#include "app/bench/mixed/mixed_walk.h"
#include "app/geometry/collineation.h"
#include "app/torch/torch.h"

#include <cstdint>
#include <vector>

namespace frustumscreen::bench {

inline constexpr double sweep_hz = 15.0;

struct TorchFrame {
    BenchPose pose;
    geometry::RigidTransform table_from_torch;
};

/// In the hand: round, 40 degrees wide, as bright as it gets up to 4 cm.
[[nodiscard]] torch::Beam sweep_beam();
/// `box`: of the artifact, prop frame.
[[nodiscard]] Result<std::vector<TorchFrame>> draw_sweep(const settings::Settings& settings,
                                                         const geometry::PropShape& prop,
                                                         const geometry::Box& box, int frames,
                                                         std::uint64_t seed);

} // namespace frustumscreen::bench
