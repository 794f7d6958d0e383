/// Compares the visitor's view, made from the projector's picture alone, with an ordinary perspective ray
/// cast of the artifact standing in the prop. This verifies the whole chain against an independent reference.
///
/// View     the exhibit's own picture of a pack's level (unlit, no compensation of the light, sRGB codes)
///          through `visitor_view`, which knows neither the artifact nor the collineation.
/// Truth    a ray from the eye through the visitor's pixel straight at the source mesh; black if it misses.
///          It knows where the prop stands, but neither the projector nor the prop's faces.
/// Judged   the pixels whose ray meets the prop. A pixel is right if no channel is off by more than 16 codes:
///          with 16 rays per pixel in both pictures, averaged in linear light; and with one ray through its
///          centre, where a texture finer than a pixel makes every filtered picture differ. The ray cast's
///          own projector picture is judged in the same way: its loss comes from the two pixel grids, not
///          from our method.
/// Size     of the visitor's picture: the largest, up to the projector's own, whose pixels on the prop are no
///          finer than the projector's: a step of one pixel in any direction spans at least one projector
///          pixel.
/// Frames   table T; metres.
/// Threads  the one whose context is current; views and rays are cast on every core.
/// Errors   any error from the parts, with the set-up's name in front.
#pragma once

#include "app/bench/measures/error_time.h"
#include "app/bench/measures/verdicts.h"
#include "app/simulation/visitor_view.h"

#include <span>
#include <string>
#include <vector>

namespace frustumscreen::bench {

/// The picture that the visitor should see; same shape as the camera's picture.
struct VisitorTruth {
    image::Image<std::uint8_t> prop; ///< 1: the ray through the pixel's centre meets a face of the prop
    image::Image<std::uint8_t> hit;  ///< 1: that ray meets the artifact
    image::Image8 colour;            ///< black off the prop and where no artifact is hit
};
/// `rays_per_side` squared rays per pixel, distributed as by `VisitorViewOptions`.
[[nodiscard]] VisitorTruth cast_visitor(const Truth& truth, const simulation::VisitorScene& scene,
                                        const simulation::VisitorCamera& camera, int rays_per_side);

/// Number of correct pixels of a view.
struct PixelAccuracy {
    std::int64_t prop_pixels = 0;
    std::int64_t prop_right = 0;
    std::int64_t artifact_pixels = 0; ///< subset of the prop's
    std::int64_t artifact_right = 0;

    [[nodiscard]] double prop_percent() const;
    [[nodiscard]] double artifact_percent() const;
};
[[nodiscard]] PixelAccuracy pixel_accuracy(const image::Image8& view, const VisitorTruth& truth);

/// The camera with the picture size described at the top.
[[nodiscard]] simulation::VisitorCamera no_finer_camera(const simulation::VisitorScene& scene);

/// View, ray cast and difference of the prop next to each other, enlarged. The difference is red where a
/// pixel is wrong, elsewhere grey and four times as bright.
[[nodiscard]] image::Image8 side_by_side(const image::Image8& view, const VisitorTruth& truth);

struct ProjectionOptions {
    int poses = 10;
    std::uint64_t seed = 1;
    PictureOptions picture;
};

/// One level, or the ray-cast picture (level -1), in one pose.
struct ProjectionRow {
    std::string technique;
    int level = -1;
    int pose = 0;
    glm::ivec2 size_px{0}; ///< size of the visitor's picture
    /// Projector pixels per step of one pixel of the visitor's picture: the minimum over the prop and all
    /// directions.
    double min_span_px = 0.0;
    PixelAccuracy one_ray;
    PixelAccuracy sixteen_rays;
};

struct ProjectionResult {
    std::string name; ///< name of the set-up
    std::vector<BenchPose> poses;
    std::vector<ProjectionRow> rows; ///< ray-cast picture, default and finest level, pose by pose
    image::Image8
        worst; ///< `side_by_side`, 16 rays: the level and pose with the smallest share of right pixels
};

[[nodiscard]] Result<ProjectionResult> projection(const SetUp& set_up, const pack::Pack& pack,
                                                  const std::shared_ptr<const bake::SourceMesh>& mesh,
                                                  const ProjectionOptions& options,
                                                  const StepProgress& progress);

inline constexpr double min_right_percent = 97.0; ///< share of the prop's pixels, in every pose
inline constexpr int max_codes_off = 16;

[[nodiscard]] std::vector<LimitVerdict> judge(const ProjectionResult& result);
[[nodiscard]] std::string projection_csv(std::span<const ProjectionResult> results);
[[nodiscard]] std::string projection_table(const ProjectionResult& result);

} // namespace frustumscreen::bench
