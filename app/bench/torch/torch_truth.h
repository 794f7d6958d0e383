/// The torch's true intensity at each pixel of a picture, in 64-bit: torch::intensity_at at the point that the pixel shows,
/// and rays from the torch for its shadows.
///
/// Point    the one that the drawn surface shows through the pixel's centre, so that a surface's own error, which other
///          commands measure, is no error of the light.
/// Shadows  by rays against the drawn surface. A pixel counts as lit, or as in shadow, if 17 rays say so: through its
///          point, and on circles of half a pixel and a pixel of the torch's own picture around it; the surface
///          beside the point is taken as flat. The surface may bend, so a hit in front of that plane by less than
///          half such a pixel's width, along the axis, counts as the surface itself. (A bound across the plane would
///          also take what shades the point, far along a grazing ray, for the surface.) A point is clearly in shadow
///          if it lies farther behind the caster than one such pixel is wide, or if the torch meets its surface from
///          behind. Within a degree of edge-on it is unclear.
/// Left out all other pixels; those within one such pixel of the beam's edge and within 1 % of its reach; and the
///          points that another surface hides from the eye's ray, which rounding causes on outlines. IntensityError
///          counts them.
/// Frames   prop.
/// Threads  `cast_torch` uses every core inside; one call at a time.
/// Errors   none.
#pragma once

#include "app/bench/torch/drawn_surface.h"
#include "app/image/image.h"
#include "app/torch/torch.h"

namespace frustumscreen::bench {

enum class TorchPlace : std::uint8_t {
    Outside, ///< of the beam, or no hit
    Lit,
    Shadow,  ///< in the beam
    Unclear, ///< left out
};

/// Shape  every image is the projector's picture.
struct TorchTruth {
    image::Image<TorchPlace> place;
    image::Image<float> intensity; ///< where lit
};

/// `points_m`: each pixel's point in the prop; NaN: none.
[[nodiscard]] TorchTruth cast_torch(const DrawnSurface& surface, const image::ImageFloat& points_m,
                                    const glm::dvec3& eye_m, const geometry::RigidTransform& prop_from_torch,
                                    const torch::Beam& beam);

/// The error of the intensity over the lit pixels of some pictures, per cent of the full intensity.
class IntensityError {
public:
    /// `drawn`: white over black, sRGB codes.
    void add(const TorchTruth& truth, const image::Image8& drawn);

    [[nodiscard]] double rmse() const;
    [[nodiscard]] double max() const { return 100.0 * max_; }
    [[nodiscard]] std::size_t pixels() const { return pixels_; }
    /// Per cent of the pixels in shadow that show light.
    [[nodiscard]] double leak() const;
    /// Per cent of the pixels in the beam, or at its edge, that are left out.
    [[nodiscard]] double unclear() const;

private:
    double squares_ = 0.0, max_ = 0.0;
    std::size_t pixels_ = 0, shadow_ = 0, leaks_ = 0, unclear_ = 0;
};

} // namespace frustumscreen::bench
