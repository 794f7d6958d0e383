/// The pose of the prop from the corners of its tags in a camera's frame, with its uncertainty.
///
/// Frames   camera C; the prop's frame P. Pixels as in pinhole.h.
/// Method   from each tag's two starts (tag_starts.h), Levenberg-Marquardt descent on the distances of all
///          corners in the frame; the best result wins. A tag that fits none of the others, because it is
///          misread or has come off, is removed and the rest fitted again.
/// Moving   a rolling shutter records each corner at another moment. If the previous pose is known, the
///          prop's motion from there to this pose is extrapolated, so each corner counts at its own moment.
/// Doubt    the covariance follows from the noise of the corners, and is larger if they fit worse than that.
///          If a second pose fits almost as well, the distance to it is added, weighted by its probability: a
///          single small tag thus has a pose with a large spread, never one without.
/// Threads  pure; any. Allocates.
/// Source   Hartley and Zisserman, Multiple view geometry, 2004, A6.2 and 5.2.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/tags/prop_tag.h"
#include "firmware_host/tags/tag_detector.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace frustumscreen::tags {

struct TagPose {
    geometry::RigidTransform camera_from_prop;
    double place_sd_m = 0.0;  ///< RMS distance of the prop's origin from the true one
    double turn_sd_rad = 0.0; ///< RMS angle from the true rotation
    std::size_t tags = 0;     ///< used
    double moment_s =
        0.0; ///< time of the pose, after the frame's first row: that of the mean row of the corners
};

/// Timing of a camera's rows, and the previous pose of the prop.
struct RollingShutter {
    double readout_s = 0.0;                         ///< from the first row to the last; 0: global shutter
    std::optional<geometry::RigidTransform> before; ///< camera_from_prop; nullopt: the prop is taken to rest
    double before_s = 0.0;                          ///< its time relative to this frame's first row: below 0
};

/// Standard deviation of each coordinate of a corner; docs/tags.md has the values for rendered scenes.
inline constexpr double usual_corner_sd_px = 0.2;

/// Whether the pose is certain enough to be followed; one with a larger spread may be that of a tag tilted to
/// the other side.
[[nodiscard]] inline bool is_sure(const TagPose& pose) {
    constexpr double max_m = 0.004;
    constexpr double max_rad = 0.045;
    return pose.place_sd_m <= max_m && pose.turn_sd_rad <= max_rad;
}

/// nullopt: no tag of the prop was found, or the tags contradict each other. Ignores unknown ids, and ids
/// that were found twice. `corner_sd_px`: of each coordinate.
[[nodiscard]] std::optional<TagPose> pose_from_tags(std::span<const FoundTag> found,
                                                    std::span<const PropTag> prop,
                                                    const geometry::Pinhole& camera, double corner_sd_px,
                                                    const RollingShutter& shutter = {});

} // namespace frustumscreen::tags
