#include "tests/simulators/table/capture_optics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace frustumscreen::simulators {

StripeProfile::StripeProfile(const calibration::StripeSetup& stripes, const calibration::Pattern& pattern,
                             const CaptureFaults& faults) {
    const int length = pattern.rows ? stripes.height : stripes.width;
    const int reach = static_cast<int>(std::ceil(4.0 * faults.projector_blur)) + 1;
    std::vector<double> light;
    for (int k = 0; k < length; ++k) {
        light.push_back(std::pow(calibration::pattern_value(stripes, pattern, k) / 255.0, faults.gamma));
    }
    // A pixel's square convolved with a Gaussian: the difference of two error functions.
    const double width = std::sqrt(2.0) * faults.projector_blur;
    for (int k = 0; k <= 8 * length; ++k) {
        const double at = k / 8.0;
        double sum = 0.0;
        for (int j = static_cast<int>(at) - reach; j <= static_cast<int>(at) + reach; ++j) {
            const double share = 0.5 * (std::erf((j + 1 - at) / width) - std::erf((j - at) / width));
            sum += share * light[static_cast<std::size_t>(std::clamp(j, 0, length - 1))];
        }
        light_.push_back(sum);
    }
}

double StripeProfile::at(double place) const {
    const double k = std::clamp(8.0 * place, 0.0, static_cast<double>(light_.size()) - 1.001);
    const auto low = static_cast<std::size_t>(k);
    const double share = k - static_cast<double>(low);
    return (1.0 - share) * light_[low] + share * light_[low + 1];
}

void blur_picture(std::vector<double>& picture, int width, int height, double sigma_px) {
    const int reach = static_cast<int>(std::ceil(3.0 * sigma_px));
    std::vector<double> kernel;
    double sum = 0.0;
    for (int k = -reach; k <= reach; ++k) {
        kernel.push_back(std::exp(-0.5 * k * k / (sigma_px * sigma_px)));
        sum += kernel.back();
    }
    for (double& share : kernel) {
        share /= sum;
    }
    const std::size_t across = static_cast<std::size_t>(width);
    std::vector<double> line; // with both ends repeated
    for (const bool columns : {false, true}) {
        const int length = columns ? height : width;
        const std::size_t step = columns ? across : 1;
        for (int each = 0; each < (columns ? width : height); ++each) {
            const std::size_t first = static_cast<std::size_t>(each) * (columns ? 1 : across);
            line.clear();
            for (int k = -reach; k < length + reach; ++k) {
                line.push_back(
                    picture[first + static_cast<std::size_t>(std::clamp(k, 0, length - 1)) * step]);
            }
            for (std::size_t k = 0; k < static_cast<std::size_t>(length); ++k) {
                picture[first + k * step] = std::inner_product(
                    kernel.begin(), kernel.end(), line.begin() + static_cast<std::ptrdiff_t>(k), 0.0);
            }
        }
    }
}

std::uint8_t grey_of(double light, const CaptureFaults& faults, double normal) {
    const double shone = std::fmax(0.0, faults.exposure * light);
    const double ideal =
        255.0 * (faults.camera_gamma == 1.0 ? shone : std::pow(shone, 1.0 / faults.camera_gamma));
    const double noisy = ideal + faults.noise * (1.0 + ideal / 255.0) * normal;
    return static_cast<std::uint8_t>(std::lround(std::clamp(noisy, 0.0, 255.0)));
}

} // namespace frustumscreen::simulators
