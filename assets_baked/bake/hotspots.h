/// Moves points given by a curator onto the artifact's surface.
///
/// Frames   in: the file's own coordinates; out: the box.
/// Errors   one line that begins with the hotspot's place: too far from the surface, or at a place that no
///          visitor can see.
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"
#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/source_scene.h"
#include "assets_baked/bake/visibility.h"
#include "firmware_host/base/result.h"

#include <string>
#include <vector>

namespace frustumscreen::bake {

struct GivenHotspot {
    std::string place; ///< where it was specified, for messages
    glm::dvec3 point_file{0.0};
    std::vector<pack::PackLabel> labels;
};

/// Largest distance of a given point from the surface, as a share of the artifact's longest edge.
inline constexpr double max_hotspot_distance_box = 0.05;

/// The nearest point of the surface, with the mean normal around it, oriented to the side from which more of
/// the viewing zone is visible.
[[nodiscard]] Result<pack::PackHotspot> put_on_surface(const GivenHotspot& given, const SourceScene& source,
                                                       const BoxFrame& frame, const ViewingZone& zone);

} // namespace frustumscreen::bake
