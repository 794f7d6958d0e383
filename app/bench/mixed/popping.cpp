#include "app/bench/mixed/popping.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::bench {

void Popping::add(const image::Image8& drawn, const image::Image8& truth,
                  const image::Image<std::uint8_t>& prop) {
    std::int64_t squares = 0;
    std::int64_t pixels = 0;
    const bool is_first = off_.empty();
    off_.resize(drawn.texels.size(), glm::ivec3(0));
    for (std::size_t k = 0; k < off_.size(); ++k) {
        const bool judged = prop.texels[k] != 0 || (!is_first && prop_.texels[k] != 0);
        const glm::ivec3 off =
            judged ? glm::ivec3(drawn.texels[k]) - glm::ivec3(truth.texels[k]) : glm::ivec3(0);
        if (judged && !is_first) {
            const glm::ivec3 jump = off - off_[k];
            squares += jump.r * jump.r + jump.g * jump.g + jump.b * jump.b;
            ++pixels;
        }
        off_[k] = off;
    }
    if (!is_first) {
        codes_.push_back(
            pixels > 0 ? std::sqrt(static_cast<double>(squares) / (3.0 * static_cast<double>(pixels))) : 0.0);
    }
    prop_ = prop;
}

double Popping::max_codes() const {
    return codes_.empty() ? 0.0 : *std::max_element(codes_.begin(), codes_.end());
}

} // namespace frustumscreen::bench
