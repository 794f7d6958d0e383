/// The number of pixels that show a place of the artifact, and the samples that each pixel therefore takes.
///
/// Units    pixels, metres.
/// Threads  pure; any. Allocates nothing.
/// Errors   none.
#pragma once

#include "app/geometry/pinhole.h"
#include "firmware_host/base/pixel_rectangle.h"

namespace frustumscreen::scene {

/// Mean over the faces of the prop that show the artifact, weighted by area.
class PixelDensity {
public:
    /// `pixels_per_m`: at the artifact's middle, as this face shows it (pixels_per_unit).
    void add(const PixelRectangle& bounds, double pixels_per_m);
    /// Pixels along a metre, as a share of those on a surface that faces the projector at that distance; 1
    /// without faces.
    [[nodiscard]] double share(double distance_m, const geometry::Pinhole& projector) const;

private:
    double pixels_ = 0.0; ///< weighted by area
    double area_ = 0.0;
};

/// Samples a pixel at this density share, if `samples` were asked for: the bake chooses them for pictures of
/// at least half the full density; each further halving of the pixels doubles the samples. At most 16. A
/// density of 0 leaves `samples` unchanged.
[[nodiscard]] int samples_at(double density, int samples);

} // namespace frustumscreen::scene
