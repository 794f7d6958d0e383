#include "app/relief/sample_light.h"

#include "app/image/image.h"

#include <cmath>

namespace frustumscreen {

SampleLight::SampleLight() {
    for (std::size_t k = 0; k < linear_.size(); ++k) {
        linear_[k] =
            static_cast<std::uint16_t>(std::lround(65535.0 * static_cast<double>(linear_from_srgb8()[k])));
    }
    for (std::size_t k = 0; k < code_.size(); ++k) {
        code_[k] = srgb8_from_linear((static_cast<double>(k) + 0.5) / static_cast<double>(code_.size()));
    }
}

} // namespace frustumscreen
