/// What every projector fulfils, roughly, as standard deviations: it keeps few touches from being explained by a projector that nobody builds.
///
/// docs/calibration.md says where each comes from. They decide nothing alone: whether touches determine a table is judged with ten times as
/// wide ones (determinacy.h).
#pragma once

namespace frustumscreen {

struct Priors {
    double aspect = 1e-2;   ///< of fx / fy: the pixels of a panel are square
    double centre_u = 0.10; ///< of cx off the picture's middle, in widths: horizontal lens shift
    double centre_v =
        0.40; ///< of cy, in widths: the vertical shift, or an offset as large as the picture's height
    double k1 = 0.2;
    double k2 = 0.05;
    double boards = 0.05; ///< of the boards' height: stacks of boards that are said to be 18 mm thick
    double print = 2e-3;  ///< of a printed sheet's size: printers, and damp paper
    double sensor_height_m = 5e-4; ///< how well a ruler or a drawing knows it
};

} // namespace frustumscreen
