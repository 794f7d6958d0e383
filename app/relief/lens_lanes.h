/// Eight pixels at once through the projector's lens: from pixels of its ideal pinhole to those that it
/// lights, and back.
///
/// Threads  pure; any. Inlined into one function for each instruction set, as lanes.h.
#pragma once

#include "app/relief/lanes.h"
#include "app/relief/pixel_lens.h"

namespace frustumscreen::relief {

struct PixelLanes {
    Floats x, y;
};

/// r^2 of the directions of ideal pixels.
FRUSTUMSCREEN_INLINE Floats squared_radius(const PixelLens& lens, const PixelLanes& ideal) {
    const Floats x = (ideal.x - lens.centre.x) * lens.per_focal.x;
    const Floats y = (ideal.y - lens.centre.y) * lens.per_focal.y;
    return x * x + y * y;
}

FRUSTUMSCREEN_INLINE PixelLanes bent(const PixelLens& lens, const PixelLanes& ideal) {
    const Floats r2 = least(squared_radius(lens, ideal), all(lens.max_r2));
    const Floats more = r2 * (lens.k1 + lens.k2 * r2);
    return {ideal.x + (ideal.x - lens.centre.x) * more, ideal.y + (ideal.y - lens.centre.y) * more};
}

/// From pixels in the picture to ideal ones, by Newton's method for the factor from the real direction to the
/// ideal one: with k1 = -0.3 and a pixel displaced by 190, three steps leave an error of 0.00001 pixel.
FRUSTUMSCREEN_INLINE PixelLanes unbent(const PixelLens& lens, const PixelLanes& real) {
    const Floats r2 = squared_radius(lens, real);
    const Floats first = lens.k1 * r2;
    const Floats second = lens.k2 * r2 * r2;
    Floats factor = all(1.0F);
    for (int step = 0; step < 3; ++step) {
        const Floats f2 = factor * factor;
        factor -= (factor * (1.0F + f2 * (first + second * f2)) - 1.0F) /
                  (1.0F + f2 * (3.0F * first + 5.0F * second * f2));
    }
    return {lens.centre.x + (real.x - lens.centre.x) * factor,
            lens.centre.y + (real.y - lens.centre.y) * factor};
}

} // namespace frustumscreen::relief
