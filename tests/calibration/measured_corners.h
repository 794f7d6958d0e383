/// Corners of simulated tables, as a technician measures them by hand.
#pragma once

#include "app/calibration/corners.h"
#include "tests/simulators/table/simulated_table.h"

#include <array>
#include <vector>

namespace frustumscreen::calibration {

/// The picture's corners on the table and on a board above it, by the truth's own rays, with a ruler's error.
inline std::vector<MeasuredCorner> measured_corners(const simulators::SimulatedTable& table, double board_m,
                                                    double ruler_m, simulators::SeededNumbers& numbers) {
    const geometry::Pinhole& p = table.truth.pinhole;
    const std::array<glm::dvec2, 4> pixels{
        {{0.0, 0.0}, {p.width, 0.0}, {p.width, p.height}, {0.0, p.height}}};
    std::vector<MeasuredCorner> corners;
    for (int distance = 1; distance <= 2; ++distance) {
        for (std::size_t k = 0; k < 4; ++k) {
            const glm::dvec3 place =
                simulators::true_light(table.truth, pixels[k], distance == 1 ? 0.0 : board_m);
            corners.push_back({distance, static_cast<PictureCorner>(k), place + ruler_m * numbers.normals()});
        }
    }
    return corners;
}

} // namespace frustumscreen::calibration
