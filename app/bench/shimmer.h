/// Shimmer: how unsteadily pixels change while the prop is moved by a tenth of a projector pixel at a time.
///
/// Steps    The prop is pushed over the table, without turning, so that its middle moves by 0.1 projector pixel
///          each step: along the picture's rows in one sequence, along its columns in another. The eye stays.
/// Measure  A picture that glides changes evenly from step to step; one that shimmers jumps to and fro. So the
///          shimmer of a pixel is the root mean square, over steps k and channels, of the second difference
///              I[k+1] - 2 I[k] + I[k-1]      (sRGB codes),
///          which even change leaves at zero and a pixel jumping every step by c raises to 2 c.
/// Truth    The same measure of the ray cast, with one ray a pixel and with 16 (4 x 4, misses black, averaged in
///          linear light, also where only a part of the pixel is covered).
/// Judged   over the pixels that show the artifact in the truth of any step, and their neighbours, as outlines
///          shift by parts of a pixel:
///          - the root mean square of all, and the value that 99.9 % of the pixels stay below: each against one
///            ray's, ratio <= 1;
///          - `excess`, which sees the few that both would hide: pixels whose shimmer is more than 8 codes above
///            that of every pixel of the one-ray truth within two pixels, as a share of the judged pixels.
/// Threads  the one whose context is current; rays are cast on every core. Flicker: values; any.
#pragma once

#include "app/bench/error_time.h"
#include "app/bench/verdicts.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen {

/// Takes pictures of one size, in order, and knows each pixel's shimmer so far.
class Flicker {
public:
    void add(Image8 picture);
    /// Codes; zero before there are three pictures.
    [[nodiscard]] Image<float> per_pixel() const;

private:
    std::array<Image8, 2> last_; ///< the one before last, the last
    Image<float> squares_;       ///< sum over steps and channels
    int pictures_ = 0;
};

/// Shimmer of one sequence over the judged pixels, codes.
struct ShimmerFigure {
    double rms = 0.0;
    double q999 = 0.0;
};
/// Over the pixels where `judged` is not zero.
[[nodiscard]] ShimmerFigure shimmer_of(const Image<float>& per_pixel, const Image<std::uint8_t>& judged);

inline constexpr float excess_codes = 8.0F;
inline constexpr int excess_reach_px = 2;
/// 1 where a judged pixel shimmers beyond its whole neighbourhood in the truth.
[[nodiscard]] Image<std::uint8_t> excess(const Image<float>& technique, const Image<float>& truth,
                                         const Image<std::uint8_t>& judged);

struct ShimmerOptions {
    int poses = 3;
    std::uint64_t seed = 1;
    int steps = 20;
    bool sixteen_rays = true; ///< the slower truth, for information
    PictureOptions picture;
};
inline constexpr double step_px = 0.1;

/// One level in one sequence.
struct ShimmerRow {
    std::string technique;
    int level = -1;
    int pose = 0;
    int direction = 0; ///< 0: along the picture's rows, 1: along its columns
    std::int64_t judged_pixels = 0;
    std::int64_t excess_pixels = 0;
    ShimmerFigure drawn;
    ShimmerFigure one_ray;
    std::optional<ShimmerFigure> sixteen_rays;

    [[nodiscard]] double rms_ratio() const;  ///< drawn / one ray
    [[nodiscard]] double q999_ratio() const; ///< drawn / one ray
    [[nodiscard]] double excess_percent() const;
};

struct ShimmerResult {
    std::string name; ///< of the set-up
    std::vector<BenchPose> poses;
    std::vector<ShimmerRow> rows;
    /// The sequence with the most excess: drawn, one ray (brighter = more shimmer), excess in red.
    Image8 worst;
};

[[nodiscard]] Result<ShimmerResult> shimmer(const SetUp& set_up, const Pack& pack,
                                            const std::shared_ptr<const SourceMesh>& mesh,
                                            const ShimmerOptions& options, const StepProgress& progress);

inline constexpr double most_ratio = 1.0;
inline constexpr double most_excess_percent = 0.1;

[[nodiscard]] std::vector<Verdict> judge(const ShimmerResult& result);
[[nodiscard]] std::string shimmer_csv(std::span<const ShimmerResult> results);
[[nodiscard]] std::string shimmer_table(const ShimmerResult& result);

} // namespace frustumscreen
