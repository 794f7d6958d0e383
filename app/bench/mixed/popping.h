/// How much of a picture's change from one frame to the next is not the artifact's own: popping.
///
/// Measure  over the prop's pixels in either frame and the three channels, the root mean square of
///              (I[k] - I[k-1]) - (T[k] - T[k-1])      (sRGB codes),
///          I drawn and T cast, both in the same light. Zero if the picture is off by the same in both frames.
/// Shape    every image is the projector's picture.
/// Threads  values; any.
/// Errors   none.
#pragma once

#include "app/bench/truth/truth.h"

#include <vector>

namespace frustumscreen::bench {

class Popping {
public:
    /// The next frame. `prop`: as TruthPicture::prop.
    void add(const image::Image8& drawn, const image::Image8& truth, const image::Image<std::uint8_t>& prop);

    /// One for each frame but the first.
    [[nodiscard]] const std::vector<double>& codes() const { return codes_; }
    [[nodiscard]] double max_codes() const;

private:
    std::vector<glm::ivec3> off_; ///< drawn - truth of the latest frame
    image::Image<std::uint8_t> prop_;
    std::vector<double> codes_;
};

} // namespace frustumscreen::bench
