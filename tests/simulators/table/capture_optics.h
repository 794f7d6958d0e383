/// What spoils captures of striped pictures, and how: the projector's gamma and focus, the camera's focus, noise and codes.
///
/// Threads  values; any.
#pragma once

#include "app/calibration/gray_code.h"
#include "tests/simulators/table/simulated_table.h"

#include <span>

namespace frustumscreen {

struct CaptureFaults {
    double ambient = 0.15;       ///< of white light
    double gamma = 2.2;          ///< of the projector: light is value ^ gamma
    double camera_gamma = 1.0;   ///< grey is light ^ (1 / gamma)
    double projector_blur = 0.8; ///< standard deviation, its pixels
    double camera_blur = 0.8;    ///< its pixels
    double noise = 1.2;          ///< grey levels of 255, in the dark; grows to twice that in white
    double exposure = 0.8;       ///< white paper in full light, as a share of the camera's range
    double corner_px = 0.1;      ///< how well a tag's corner is found, standard deviation of each coordinate
};

/// The light of a pattern along its axis, blurred.
class StripeProfile {
public:
    StripeProfile(const StripeSetup& stripes, const Pattern& pattern, const CaptureFaults& faults);
    /// `place`: column or row, of full light 1.
    [[nodiscard]] double at(double place) const;

private:
    std::vector<double> light_; ///< eight places a pixel
};

/// Gaussian, along both axes; edges are repeated. `picture[height][width]`.
void blur_picture(std::vector<double>& picture, int width, int height, double sigma_px);

/// `normal`: a number of chance.
[[nodiscard]] std::uint8_t grey_of(double light, const CaptureFaults& faults, double normal);

} // namespace frustumscreen
