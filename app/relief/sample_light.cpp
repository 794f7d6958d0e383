#include "app/relief/sample_light.h"

#include "app/image/image.h"

#include <cmath>

namespace frustumscreen::relief {

SampleLight::SampleLight() {
    for (std::size_t k = 0; k < linear_.size(); ++k) {
        linear_[k] = static_cast<std::uint16_t>(
            std::lround(65535.0 * static_cast<double>(image::linear_from_srgb8()[k])));
    }
    for (std::size_t k = 0; k < code_.size(); ++k) {
        code_[k] =
            image::srgb8_from_linear((static_cast<double>(k) + 0.5) / static_cast<double>(code_.size()));
    }
}

} // namespace frustumscreen::relief
