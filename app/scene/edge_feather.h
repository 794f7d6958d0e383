/// Softens the light at the edges of the prop's faces.
///
/// Shared   a pixel on an edge of two faces lights both, but has the gain of the one that holds its middle. Where
///          the gains differ, such pixels would sparkle as the prop moves. So the face with the larger gain is
///          dimmed towards the other's over the last pixel before the edge: at the edge both agree, and a pixel's
///          light changes by degrees when the edge crosses it. The dimmer one wins, because a place that is too
///          bright catches the eye more than one that is too dark.
/// Outer    behind an edge where the prop ends for the projector, half of a pixel's light would fall on the table
///          as a bright line. There the face goes dark half a pixel before the edge.
///
/// Frames   clip coordinates as `Pinhole::clip_from_point`, w = 1.
/// Threads  pure; any. Allocates nothing if the plan has room (make_plan).
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/prop_shape.h"
#include "app/scene/light.h"

#include <glm/glm.hpp>

#include <array>
#include <vector>

namespace frustumscreen {

struct FramePlan;

/// A strip of a face along an edge.
struct EdgeFeather {
    int face = 0;                            ///< index into FramePlan::faces: only its pixels are dimmed
    std::array<glm::vec4, 4> corners_clip{}; ///< the edge's two ends, then the strip's inner corners
    /// Factor of linear light at the edge's ends; inside it goes straight to 1. Below 0 counts as 0.
    glm::vec2 share{1.0F};
};

/// Fills `plan.feathers` from its faces, which have their light. `projector`: prop frame.
void feather_edges(const PropShape& prop, const glm::dvec3& projector, FramePlan& plan);

} // namespace frustumscreen
