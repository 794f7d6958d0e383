/// Faults of captures of striped pictures: the projector's gamma and focus, the camera's focus, noise and
/// quantisation.
///
/// Threads  values; any.
#pragma once

#include "app/calibration/gray_code.h"
#include "tests/simulators/table/simulated_table.h"

namespace frustumscreen::simulators {

struct CaptureFaults {
    double ambient = 0.15;       ///< share of white light
    double gamma = 2.2;          ///< of the projector: light is value ^ gamma
    double camera_gamma = 1.0;   ///< grey is light ^ (1 / gamma)
    double projector_blur = 0.8; ///< standard deviation, in projector pixels
    double camera_blur = 0.8;    ///< standard deviation, in camera pixels
    double noise = 1.2;          ///< grey levels of 255, in the dark; twice that in white
    double exposure = 0.8;       ///< white paper in full light, as a share of the camera's range
    double corner_px = 0.1;      ///< error of a found tag corner, standard deviation per coordinate
};

/// The blurred light of a pattern along its axis.
class StripeProfile {
public:
    StripeProfile(const calibration::StripeSetup& stripes, const calibration::Pattern& pattern,
                  const CaptureFaults& faults);
    /// `place`: column or row. Full light is 1.
    [[nodiscard]] double at(double place) const;

private:
    std::vector<double> light_; ///< eight samples per pixel
};

/// Gaussian, along both axes; edges are repeated. `picture[height][width]`.
void blur_picture(std::vector<double>& picture, int width, int height, double sigma_px);

/// `normal`: a standard normal random number.
[[nodiscard]] std::uint8_t grey_of(double light, const CaptureFaults& faults, double normal);

} // namespace frustumscreen::simulators
