/// How far a picture is from the truth, as docs/conventions.md defines it.
///
/// Units    millimetres, projector pixels, 8-bit sRGB codes, percent.
/// Threads  pure; any.
#pragma once

#include "app/bench/truth/truth.h"

#include <optional>
#include <span>
#include <vector>

namespace frustumscreen {

/// What a technique drew. Shape as the truth's images.
struct Drawn {
    Image8 colour;
    ImageFloat point_m; ///< hit point, prop frame; NaN = no hit
};

struct ColourError {
    double rmse = 0.0;        ///< over the three channels of all pixels hit in both
    double bad_percent = 0.0; ///< pixels off by more than 16 codes in any channel
};

/// Of the picture that the kiosk shows, lit and with all its samples.
struct ShownError {
    /// How far the share of a pixel that is covered lies from that of the truth's 16 rays: summed over the picture, over the outline's
    /// pixels. With exact outlines n samples leave some 1 / (4 n), since they know n + 1 covers.
    double cover_px = 0.0;
    double cover_of_samples_px = 0.0; ///< the same of as many rays at the truth, on a regular grid
    /// The whole picture's cover beside the truth's, over outline pixels: how far the artifact is too fat or too thin. However few
    /// samples there are, they are right on average.
    double cover_bias_px = 0.0;
    ColourError colour; ///< against 16 rays in the same light; over pixels hit in both
    double shift_px = 0.0;
};

struct PictureError {
    std::int64_t truth_pixels = 0;   ///< the truth's artifact pixels
    std::int64_t outline_pixels = 0; ///< of them, those with a 4-neighbour not hit
    std::int64_t mismatched_pixels = 0;
    double geometric_mean_mm = 0.0;
    double geometric_p95_mm = 0.0;
    double silhouette_percent = 0.0; ///< mismatched / truth pixels
    double outline_shift_px = 0.0;   ///< mismatched / outline pixels
    /// Of the shown picture against 16 rays (picture_shift.h); zero where the truth has none. A simplified outline that gives way
    /// more on one side than on the other shifts the picture too.
    double picture_shift_px = 0.0;
    /// Of the shown picture against 16 rays at the very surface that is drawn: how far drawing alone puts it beside its place. Zero
    /// where nobody asked.
    double drawn_shift_px = 0.0;
    ColourError one_ray;
    ColourError sixteen_rays;        ///< zero where the truth has none
    std::optional<ShownError> shown; ///< nothing: the kiosk shows no such picture, or nobody asked
};

/// A truth without artifact pixels gives zero errors if nothing was drawn. Otherwise the errors are those of
/// a truth with one artifact pixel.
[[nodiscard]] PictureError measure(const TruthPicture& truth, const Drawn& drawn);

/// As `ShownPicture` draws them.
struct ShownImages {
    Image8 colour;
    Image8 white;
    int samples = 1; ///< a pixel of `white`
};
/// The truth has `shown16`. `cover_of_samples`: by Truth::cover, with as many rays as samples. `points_m` as in `Drawn`.
[[nodiscard]] ShownError measure_shown(const TruthPicture& truth, const ShownImages& shown,
                                       const Image<float>& cover_of_samples, const ImageFloat& points_m);

/// Mean and worst of each figure over many pictures.
struct ErrorSummary {
    PictureError mean;
    PictureError worst;  ///< each figure's own greatest
    int worst_pose = -1; ///< index of the picture with the greatest silhouette error
};
[[nodiscard]] ErrorSummary summarise(std::span<const PictureError> errors);

} // namespace frustumscreen
