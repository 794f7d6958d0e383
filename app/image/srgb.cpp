#include "app/image/image.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::image {

namespace {

/// thresholds[k] is the linear light of sRGB code k + 1/2: codes above k begin there.
std::array<double, 255> make_thresholds() {
    std::array<double, 255> thresholds{};
    for (std::size_t k = 0; k < thresholds.size(); ++k) {
        thresholds[k] = linear_from_srgb((static_cast<double>(k) + 0.5) / 255.0);
    }
    return thresholds;
}

std::array<float, 256> make_codes() {
    std::array<float, 256> codes{};
    for (std::size_t k = 0; k < codes.size(); ++k) {
        codes[k] = static_cast<float>(linear_from_srgb(static_cast<double>(k) / 255.0));
    }
    return codes;
}

} // namespace

double linear_from_srgb(double srgb01) {
    return srgb01 <= 0.04045 ? srgb01 / 12.92 : std::pow((srgb01 + 0.055) / 1.055, 2.4);
}

double srgb_from_linear(double linear01) {
    return linear01 <= 0.0031308 ? linear01 * 12.92 : 1.055 * std::pow(linear01, 1.0 / 2.4) - 0.055;
}

const std::array<float, 256>& linear_from_srgb8() {
    static const std::array<float, 256> codes = make_codes();
    return codes;
}

std::uint8_t srgb8_from_linear(double linear01) {
    if (!(linear01 > 0.0)) { // also for NaN
        return 0;
    }
    static const std::array<double, 255> thresholds = make_thresholds();
    const auto above = std::upper_bound(thresholds.begin(), thresholds.end(), linear01);
    return static_cast<std::uint8_t>(above - thresholds.begin());
}

} // namespace frustumscreen::image
