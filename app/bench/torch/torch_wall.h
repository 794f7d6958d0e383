/// The paper's Fig. 3 in numbers: a torch before a wall of two triangles, split by edge length and by the bound of the error, for
/// each attenuation.
///
/// Frames   the wall's own, metres: x across, y up, from its middle.
/// Threads  pure; any.
/// Errors   none.
#pragma once

#include "app/torch/splitting.h"

#include <string>
#include <vector>

namespace frustumscreen::bench {

struct WallRow {
    torch::Attenuation attenuation = torch::Attenuation::InverseSquare;
    torch::Splitting splitting;
    std::size_t triangles = 0;
    double rmse = 0.0,
           max = 0.0; ///< of the intensity over the lit part of the wall, per cent of the full one
};
/// Each attenuation and heuristic, from coarse to fine.
[[nodiscard]] std::vector<WallRow> measure_wall();
[[nodiscard]] std::string torch_wall_csv(const std::vector<WallRow>& rows);

/// The triangles of three walls, at a short, a medium and a long edge, with their corners' intensities.
[[nodiscard]] std::string torch_triangles_csv();

} // namespace frustumscreen::bench
