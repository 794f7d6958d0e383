/// Softens the light at the edges of the prop's faces.
///
/// Shared   a pixel on an edge of two faces lights both, but has the gain of the face that holds its centre.
///          Where the gains differ, such pixels would sparkle as the prop moves. The face with the larger
///          gain is therefore dimmed towards the other's gain over the last pixel before the edge: at the
///          edge both agree, and a pixel's light changes gradually when the edge crosses it. The dimmer gain
///          wins, because a place that is too bright is more noticeable than one that is too dark. The same holds
///          beside a face that shows nothing, because half of such a pixel's light falls on that face.
/// Outer    at an edge of the prop's outline, as the projector sees it, half of a pixel's light would fall on
///          the table as a bright line. There the face goes dark half a pixel before the edge.
///
/// Frames   clip coordinates as `Pinhole::clip_from_point`, w = 1.
/// Threads  pure; any. Allocates nothing if the plan has the space (make_plan).
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/prop_shape.h"
#include "app/scene/light.h"

#include <glm/glm.hpp>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::scene {

struct FramePlan;

/// A strip of a face along an edge.
struct EdgeFeather {
    int face = 0;                            ///< index into FramePlan::faces: only its pixels are dimmed
    std::array<glm::vec4, 4> corners_clip{}; ///< the edge's two ends, then the strip's inner corners
    /// Factor of linear light at the edge's ends; it rises linearly to 1 at the inner side. Values below 0
    /// count as 0.
    glm::vec2 share{1.0F};
};

/// Fills `plan.feathers` from its faces, whose light must be set. `projector`: prop frame. `lights`: for each of the
/// prop's faces, its light; nullopt for one that the eye does not see, or that may show nothing.
void feather_edges(const geometry::PropShape& prop, const glm::dvec3& projector,
                   std::span<const std::optional<FaceLight>> lights, FramePlan& plan);

} // namespace frustumscreen::scene
