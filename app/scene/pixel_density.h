/// How many pixels show a place of the artifact, and how many samples each of them takes therefore.
///
/// Units    pixels, metres.
/// Threads  pure; any. Allocates nothing.
/// Errors   none.
#pragma once

#include "app/geometry/pinhole.h"
#include "firmware_host/base/pixel_rectangle.h"

namespace frustumscreen {

/// A mean over the faces of the prop that show it, by area.
class PixelDensity {
public:
    /// `pixels_per_m`: at the artifact's middle, as this face shows it (pixels_per_unit).
    void add(const PixelRectangle& bounds, double pixels_per_m);
    /// Pixels along a metre, as a share of those on a surface that faces the projector at that distance; 1 without faces.
    [[nodiscard]] double share(double distance_m, const Pinhole& projector) const;

private:
    double pixels_ = 0.0; ///< weighed by area
    double area_ = 0.0;
};

/// How many samples a pixel takes that asked for `samples`, at such a share: the bake chooses them for pictures of at least half the
/// density, and each further half of the pixels takes twice the samples. At most 16; as asked for where the density is 0.
[[nodiscard]] int samples_at(double density, int samples);

} // namespace frustumscreen
