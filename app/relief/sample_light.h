/// Mean light of a pixel's samples.
///
/// Colour   sRGB codes; averages in linear light, black without a hit. Integers, so that every machine gets
///          equal results.
/// Threads  const; any.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>

namespace frustumscreen::relief {

class SampleLight {
public:
    SampleLight();
    /// The mean of `count` samples whose light adds up to `sum`, as codes. Alpha is 255.
    [[nodiscard]] glm::u8vec4 mean(const glm::uvec3& sum, unsigned count) const {
        const auto code = [&](unsigned light) { return code_[light / count / 4]; };
        return {code(sum.x), code(sum.y), code(sum.z), 255};
    }
    [[nodiscard]] glm::uvec3 light(const glm::u8vec4& code) const {
        return {linear_[code.x], linear_[code.y], linear_[code.z]};
    }

private:
    std::array<std::uint16_t, 256> linear_{}; ///< 65535 = 1
    std::array<std::uint8_t, 16384> code_{};  ///< of linear light / 4
};

} // namespace frustumscreen::relief
