/// Shimmer: how unsteadily pixels change while the prop moves in steps of a tenth of a projector pixel.
///
/// Steps    The prop is pushed over the table, without turning, by steps that move its middle by 0.1 pixel:
///          along the picture's rows in one sequence, along its columns in another. The eye stays.
/// Measure  A picture that glides changes evenly from step to step; one that shimmers jumps to and fro. A
///          pixel's shimmer is the root mean square, over steps k and channels, of the second difference
///              I[k+1] - 2 I[k] + I[k-1]      (sRGB codes),
///          which is zero for even change and 2 c for a pixel that jumps by c every step.
/// Truth    The same measure for the ray cast, with one ray per pixel and with 16 (4 x 4, misses black,
///          averaged in linear light, also where only a part of the pixel is covered).
/// Judged   Over the pixels that show the artifact in the truth of any step, and their neighbours, because
///          outlines shift by parts of a pixel:
///          - the root mean square of all, and the value that 99.9 % of the pixels stay below: each divided
///            by one ray's;
///          - `excess`, for the few pixels that both values would hide: pixels whose shimmer is more than 8
///            codes above that of every pixel within two pixels in either truth, as a share of the judged
///            pixels. (Along an edge that nearly follows a row, one ray jumps at few pixels, far apart, and
///            16 rays jump a little at each.)
/// Threads  Rays are cast on every core; everything else is plain values.
/// Errors   none.
#pragma once

#include "app/bench/truth/poses.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace frustumscreen::bench {

inline constexpr double step_px = 0.1;

/// Takes pictures of one size in order and computes each pixel's shimmer so far.
class Flicker {
public:
    void add(image::Image8 picture);
    /// Codes; zero until there are three pictures.
    [[nodiscard]] image::Image<float> per_pixel() const;

private:
    std::array<image::Image8, 2> last_; ///< the one before last, then the last
    image::Image<float> squares_;       ///< sum over steps and channels
    int pictures_ = 0;
};

/// Shimmer of one sequence over the judged pixels, codes.
struct ShimmerFigure {
    double rms = 0.0;
    double q999 = 0.0;
};
/// Over the pixels where `judged` is not zero.
[[nodiscard]] ShimmerFigure shimmer_of(const image::Image<float>& per_pixel,
                                       const image::Image<std::uint8_t>& judged);

inline constexpr float excess_codes = 8.0F;
inline constexpr int excess_reach_px = 2;
/// 1 at judged pixels that shimmer more than their whole neighbourhood in the truth.
[[nodiscard]] image::Image<std::uint8_t> excess(const image::Image<float>& technique,
                                                const image::Image<float>& truth,
                                                const image::Image<std::uint8_t>& judged);

/// One technique in one sequence.
struct SequenceShimmer {
    std::int64_t judged_pixels = 0;
    std::int64_t excess_pixels = 0;
    ShimmerFigure drawn;
    ShimmerFigure one_ray;
    std::optional<ShimmerFigure> sixteen_rays;

    [[nodiscard]] double rms_ratio() const;  ///< drawn / one ray
    [[nodiscard]] double q999_ratio() const; ///< drawn / one ray
    [[nodiscard]] double excess_percent() const;
};

/// A pixel's shimmer, drawn and in the truth.
struct ShimmerMaps {
    image::Image<float> drawn;
    image::Image<float> one_ray;
    image::Image<std::uint8_t> judged;
    image::Image<std::uint8_t> beyond; ///< from `excess`
};
/// Drawn and one ray in grey at twice their value, the excess in red; next to each other.
[[nodiscard]] image::Image8 side_by_side(const ShimmerMaps& maps);

/// Along the picture's rows or its columns.
enum class PushDirection { Row, Column };

/// One prop pushed in one direction. Keeps only the part of the picture around the prop.
class ShimmerSequence {
public:
    /// `settings` and `prop` must outlive the sequence. It has steps + 1 poses.
    ShimmerSequence(const settings::Settings& settings, const geometry::PropShape& prop,
                    const BenchPose& pose, PushDirection direction, int steps);
    [[nodiscard]] const std::vector<BenchPose>& poses() const { return poses_; }

    /// Casts the truth for every technique. Call it once, before `judge`.
    void cast(const Truth& truth, bool sixteen_rays);

    /// Draws the projector's whole picture of a pose.
    using Draw = std::function<image::Image8(const BenchPose&)>;
    [[nodiscard]] SequenceShimmer judge(const Draw& draw, ShimmerMaps& maps) const;

private:
    /// A rectangle of the projector's picture.
    struct Part {
        glm::ivec2 low{0};
        glm::ivec2 size{0};
    };
    [[nodiscard]] Part part_around_prop() const;
    [[nodiscard]] TruthView view_of_part(const BenchPose& pose, int split) const;
    [[nodiscard]] image::Image8 cut(const image::Image8& picture) const;

    const settings::Settings& settings_;
    const geometry::PropShape& prop_;
    std::vector<BenchPose> poses_;
    Part part_;
    image::Image<std::uint8_t> judged_;
    image::Image<float> one_ray_;
    image::Image<float> allowed_; ///< the larger of the two truths
    SequenceShimmer truth_;       ///< the parts shared by every technique
};

} // namespace frustumscreen::bench
