/// Priors that every projector roughly satisfies, as standard deviations: they keep a few touches from being
/// explained by a projector that does not exist.
///
/// docs/calibration.md gives the source of each. They decide nothing alone: determinacy.h judges whether
/// touches determine a table with priors ten times as wide.
#pragma once

namespace frustumscreen::calibration {

struct Priors {
    double aspect = 1e-2;   ///< of fx / fy: the pixels of a panel are square
    double centre_u = 0.10; ///< of cx off the picture's middle, in widths: horizontal lens shift
    double centre_v = 0.40; ///< of cy, in widths: vertical shift, or an offset up to the picture's height
    double k1 = 0.2;
    double k2 = 0.05;
    double boards = 0.05;          ///< of the boards' height: stacks of boards of nominally 18 mm
    double print = 2e-3;           ///< of a printed sheet's size: printer scale, damp paper
    double sensor_height_m = 5e-4; ///< accuracy of a ruler or a drawing
};

} // namespace frustumscreen::calibration
