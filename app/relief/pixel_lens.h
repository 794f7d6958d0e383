/// The projector's lens (geometry/lens.h), between pixels of its ideal pinhole and those that it lights, in
/// 32-bit arithmetic.
///
/// Threads  values; any.
#pragma once

#include "app/geometry/pinhole.h"

namespace frustumscreen::relief {

struct PixelLens {
    glm::vec2 centre{0.0F}, focal{1.0F}, per_focal{1.0F};
    float k1 = 0.0F, k2 = 0.0F;
    float max_r2 = 0.0F; ///< beyond this, the factor stays constant (Pinhole::bends_to_r2)
    bool bends = false;

    PixelLens() = default;
    explicit PixelLens(const geometry::Pinhole& pinhole)
        : centre(pinhole.cx, pinhole.cy), focal(pinhole.fx, pinhole.fy), per_focal(1.0F / focal),
          k1(static_cast<float>(pinhole.lens.k1)), k2(static_cast<float>(pinhole.lens.k2)),
          max_r2(static_cast<float>(pinhole.bends_to_r2())), bends(!pinhole.lens.is_plain()) {}
};

} // namespace frustumscreen::relief
