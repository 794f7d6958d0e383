/// Finds the sides of triangles that a visitor can see at all.
///
/// Frame    box; the eyes are those of the viewing zone, at every azimuth (the prop can be turned), from
///          `lowest_elevation_deg` up to straight above.
/// Method   for sample points on each triangle it searches for one eye of the zone that sees them. The result
///          is grown over touching triangles and a little beyond, so that no picture shows an edge of the
///          kept surface.
/// Threads  uses all cores; deterministic.
#pragma once

#include "assets_baked/bake/source_scene.h"
#include "assets_baked/bake/triangle_mesh.h"

#include <vector>

namespace frustumscreen::bake {

/// Possible positions of eyes relative to the artifact; generous, because one pack serves every kiosk.
struct ViewingZone {
    double lowest_elevation_deg = 3.0; ///< above the prop's bottom, seen from its centre
    double nearest_box = 2.0;          ///< distance in box units
    double farthest_box = 20.0;

    /// For a prop that can have any orientation.
    [[nodiscard]] static ViewingZone all_around() {
        ViewingZone zone;
        zone.lowest_elevation_deg = -90.0;
        return zone;
    }
};

/// The triangles of `mesh` whose counter-clockwise side is visible, and a flipped copy of those whose other
/// side is visible: the result can be drawn with back faces culled. `scene` occludes.
[[nodiscard]] TriangleMesh visible_sides(const TriangleMesh& mesh, const SourceScene& scene,
                                         const ViewingZone& zone);

/// Visible sides of a region of a site. `curtains`: what hides the region's underside, and nothing else. Kept are the sides visible past
/// `scene` and `curtains`, and the ones visible past `scene` alone that look up (+z), such as the floor inside a hill that the
/// prop cuts open.
[[nodiscard]] TriangleMesh visible_region_sides(const TriangleMesh& mesh, const SourceScene& scene,
                                                const SourceScene& curtains, const ViewingZone& zone);

/// For each triangle, whether one of its sides is visible.
[[nodiscard]] std::vector<bool> visible_triangles(const TriangleMesh& mesh, const SourceScene& scene,
                                                  const ViewingZone& zone);

/// The triangles of a coarser `mesh` (with flipped copies) on sides that are kept in `finer`.
[[nodiscard]] TriangleMesh visible_sides_like(const TriangleMesh& mesh, const TriangleMesh& finer,
                                              const SourceScene& finer_scene, float tolerance_box);

} // namespace frustumscreen::bake
