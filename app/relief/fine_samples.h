/// More samples for the pixels that need them: which these are, where their rays go, and what they average to.
///
/// Frames   pixels from the picture's corner. `LitCodes` holds the view's lit part with a rim of nothing around it.
/// Colour   sRGB codes; averages in linear light, where nothing is met black. Integers, so that every machine makes the same.
/// Threads  bands of tiles are apart: one FineBand each. `LitCodes` is only read while bands are gathered.
/// Memory   kept from frame to frame.
#pragma once

#include "app/relief/cast_blocks.h"
#include "app/relief/picture_span.h"
#include "firmware_host/base/pixel_rectangle.h"

#include <array>
#include <cstdint>
#include <vector>

namespace frustumscreen {

/// The picture with one sample a pixel.
class LitCodes {
public:
    /// Everywhere nothing. `lit` begins and ends at whole tiles or at the picture's edge.
    void begin(const PixelRectangle& lit);
    [[nodiscard]] const PixelRectangle& lit() const { return lit_; }
    [[nodiscard]] glm::u8vec4* row(int y) {
        return &codes_[static_cast<std::size_t>(y - lit_.y + 1) * stride_ + rim];
    }
    /// Columns from `lit().x` on that hold something, the last one excluded; whoever writes a row says so.
    struct Extent {
        int first = 0, end = 0;
    };
    [[nodiscard]] Extent& extent(int y) { return extents_[static_cast<std::size_t>(y - lit_.y + 1)]; }
    /// For each pixel of a row, not zero where it differs from one of its four neighbours: an outline, or busy texture. Pixels outside
    /// of the extent that is returned do not, and are not written.
    Extent find_busy(int y, std::vector<std::int32_t>& busy);

private:
    static constexpr std::size_t rim = 8; ///< texels at either end of a row: as many as are compared at once

    PixelRectangle lit_;
    std::size_t stride_ = 0;
    std::vector<glm::u8vec4> codes_;
    std::vector<Extent> extents_; ///< of the rows, and of the rim above and below
};

/// Mean light of a pixel's samples.
class SampleLight {
public:
    SampleLight();
    /// Of `count` codes, the missing ones black. Alpha is 255.
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

/// The pixels of a band of tiles that get more samples.
class FineBand {
public:
    /// Finds them, and lays `samples` rays (a power of two) through each.
    void gather(LitCodes& codes, TileBand band, int samples);
    [[nodiscard]] CastRays& rays() { return rays_; }
    /// Writes the means of what `rays` have met.
    void resolve(const BlockRelief& relief, const SampleLight& light, int samples,
                 const PictureSpan<glm::u8vec4>& picture) const;
    [[nodiscard]] std::size_t pixels() const { return pixels_.size(); }

private:
    struct Pixel {
        std::uint16_t x = 0, y = 0;
        std::uint32_t first_ray = 0;
    };
    CastRays rays_;
    std::vector<Pixel> pixels_;
    std::array<std::vector<std::int32_t>, tile_height> busy_;
};

} // namespace frustumscreen
