/// How far a picture is from the truth, as defined in docs/conventions.md.
///
/// Units    millimetres, projector pixels, 8-bit sRGB codes, percent.
/// Threads  pure; any.
#pragma once

#include "app/bench/truth/truth.h"

#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::bench {

/// The result of a technique; same shape as the truth's images.
struct Drawn {
    image::Image8 colour;
    image::ImageFloat point_m; ///< hit point, prop frame; NaN = no hit
};

struct ColourError {
    double rmse = 0.0;        ///< over the three channels of all pixels hit in both pictures
    double bad_percent = 0.0; ///< pixels off by more than 16 codes in any channel
};

/// Errors of the picture that the kiosk shows, lit and with all its samples.
struct ShownError {
    /// Difference between a pixel's covered share and the share of the truth's 16 rays, summed over the
    /// outline's pixels. With exact outlines n samples leave about 1 / (4 n), since they can represent n + 1
    /// levels of coverage.
    double cover_px = 0.0;
    double cover_of_samples_px = 0.0; ///< `cover_px` of the truth itself, cast with as many rays on a regular
                                      ///< grid
    /// Total coverage of the picture minus that of the truth, per outline pixel: how far the artifact is too
    /// fat or too thin. Independent of the number of samples, which are right on average.
    double cover_bias_px = 0.0;
    ColourError colour; ///< against 16 rays in the same light; over pixels hit in both pictures
    double shift_px = 0.0;
};

struct PictureError {
    std::int64_t truth_pixels = 0;   ///< the truth's artifact pixels
    std::int64_t outline_pixels = 0; ///< those with a 4-neighbour that is not hit
    std::int64_t mismatched_pixels = 0;
    double geometric_mean_mm = 0.0;
    double geometric_p95_mm = 0.0;
    double silhouette_percent = 0.0; ///< mismatched / truth pixels
    double outline_shift_px = 0.0;   ///< mismatched / outline pixels
    /// Shift of the shown picture against 16 rays (picture_shift.h); zero if the truth has none. A simplified
    /// outline that recedes more on one side than on the other shifts the picture too.
    double picture_shift_px = 0.0;
    /// Shift of the shown picture against 16 rays at exactly the surface that is drawn: the share of the
    /// shift caused by drawing alone. Zero if it was not requested.
    double drawn_shift_px = 0.0;
    ColourError one_ray;
    ColourError sixteen_rays;        ///< zero if the truth has none
    std::optional<ShownError> shown; ///< nullopt: the kiosk shows no such picture, or it was not requested
};

/// A truth without artifact pixels gives zero errors if nothing was drawn; otherwise the errors are computed
/// as for a truth with one artifact pixel.
[[nodiscard]] PictureError measure(const TruthPicture& truth, const Drawn& drawn);

/// As drawn by `ShownPicture`.
struct ShownImages {
    image::Image8 colour;
    image::Image8 white;
    int samples = 1; ///< samples per pixel of `white`
};
/// Requires `shown16` in the truth. `cover_of_samples`: from Truth::cover, with as many rays as samples.
/// `points_m` as in `Drawn`.
[[nodiscard]] ShownError measure_shown(const TruthPicture& truth, const ShownImages& shown,
                                       const image::Image<float>& cover_of_samples,
                                       const image::ImageFloat& points_m);

/// Mean and worst value of each error over many pictures.
struct ErrorSummary {
    PictureError mean;
    PictureError worst;  ///< each error's own maximum
    int worst_pose = -1; ///< index of the picture with the largest silhouette error
};
[[nodiscard]] ErrorSummary summarise(std::span<const PictureError> errors);

} // namespace frustumscreen::bench
