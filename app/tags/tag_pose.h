/// Where the prop is, by the corners of its tags in a camera's frame, and how sure that is.
///
/// Frames   camera C; the prop's frame P. Pixels as pinhole.h has them.
/// Method   from each tag's two starts (tag_starts.h) Levenberg and Marquardt's descent on the distances of all corners in the
///          frame; the best of what comes out. A tag that fits none of the others, because it is read wrong or has come off, is
///          left out and the rest fitted anew.
/// Moving   a camera whose shutter reads row after row sees each corner in another moment. Where the pose before is known, the prop is taken to go on
///          as it went from there to this pose, so that all corners count at their own moments.
/// Doubt    the covariance follows from the noise of the corners, and is larger where they fit worse than that. Where a second pose
///          fits almost as well, the distance to it counts too, by how likely that one is: a single small tag has a pose with a
///          large spread, and no pose without one.
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

namespace frustumscreen {

struct TagPose {
    RigidTransform camera_from_prop;
    double place_sd_m = 0.0;  ///< RMS distance of the prop's origin from the true one
    double turn_sd_rad = 0.0; ///< RMS angle from the true turn
    std::size_t tags = 0;     ///< used
    double moment_s =
        0.0; ///< at which it is the prop's, after the frame's first row: that of the row amid the corners
};

/// How a camera's rows are read, and where the prop was before.
struct RollingShutter {
    double readout_s = 0.0;               ///< from the first row to the last; 0: all at once
    std::optional<RigidTransform> before; ///< camera_from_prop; nothing: the prop is taken to rest
    double before_s = 0.0;                ///< its moment, after this frame's first row: below 0
};

/// Of each coordinate of a corner, standard deviation: docs/tags.md has what rendered scenes give.
inline constexpr double usual_corner_sd_px = 0.2;

/// Sure enough to be followed; a pose with a larger spread may be that of a tag that leans to the other side.
[[nodiscard]] inline bool is_sure(const TagPose& pose) {
    constexpr double most_m = 0.004;
    constexpr double most_rad = 0.045;
    return pose.place_sd_m <= most_m && pose.turn_sd_rad <= most_rad;
}

/// Nothing: no tag of the prop is there, or they contradict each other so that none is to be believed. Ids that the prop has not are
/// passed over, and so is one that is found twice. `corner_sd_px`: of each coordinate.
[[nodiscard]] std::optional<TagPose> pose_from_tags(std::span<const FoundTag> found,
                                                    std::span<const PropTag> prop, const Pinhole& camera,
                                                    double corner_sd_px, const RollingShutter& shutter = {});

} // namespace frustumscreen
