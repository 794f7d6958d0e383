/// Makes a level of the pack from charted triangles: quantised, ordered for the vertex cache, cut into
/// clusters, measured.
///
/// Frame    box.
/// Threads  pure; any (measure uses all cores).
/// Library  meshoptimizer (vertex order).
#pragma once

#include "app/pack/pack.h"
#include "app/pack/pack_relief.h"
#include "app/pack/seen_errors.h"
#include "assets_baked/bake/charts.h"
#include "assets_baked/bake/source_scene.h"
#include "assets_baked/bake/visibility.h"

#include <functional>
#include <span>

namespace frustumscreen::bake {

/// A level with vertices, indices and clusters; the caller sets texture and error.
[[nodiscard]] pack::PackLevel make_level(const ChartedMesh& mesh, const glm::dvec3& box_size);

/// The mesh as stored in a level: with its positions rounded to the pack's codes.
[[nodiscard]] TriangleMesh on_codes(TriangleMesh mesh, const glm::dvec3& box_size);

/// Rebuilds a level's surface from its quantised vertices.
[[nodiscard]] TriangleMesh surface_of(const pack::PackLevel& level, const glm::dvec3& box_size);

/// A level's surface with its texture, for ray casts; rays pass where the texture's alpha cuts. `texture` must outlive
/// it.
[[nodiscard]] SourceMesh textured_source(const pack::PackLevel& level, const image::Image8& texture,
                                         const glm::dvec3& box_size);

/// Points on the source that a visitor sees, with their colour: chosen once, and compared with every level.
struct SourceSamples {
    struct Point {
        glm::vec3 position{0.0F};
        glm::vec3 normal{0.0F}; ///< of the visible side
        glm::vec3 colour{0.0F}; ///< linear
    };
    std::vector<Point> points;
    /// Corners of the visible surface. Thin parts have hardly any area, and so few points, but they have
    /// corners.
    std::vector<glm::vec3> corners;
    double share = 1.0; ///< relative to the usual number of points
};
/// `visible` is the kept surface of the finest level: only source points near it are chosen.
[[nodiscard]] SourceSamples sample_source(const SourceScene& source, const TriangleMesh& visible,
                                          float tolerance_box, double share = 1.0);

/// Measures in both directions: the surface's points against the source, the source's visible points against
/// the surface. The maximum also includes the source's corners. Colour is left at 0.
[[nodiscard]] pack::LevelError measure_shape(const TriangleMesh& surface, const SourceScene& source,
                                             const SourceSamples& samples);
/// RMSE over the source's visible points, in 8-bit codes. Only meaningful for unlit textures: baked light is
/// not an error.
[[nodiscard]] float measure_colour(const pack::PackLevel& level, const image::Image8& texture,
                                   const glm::dvec3& box_size, const SourceSamples& samples);
/// Shape and, if `compare_colour`, colour.
[[nodiscard]] pack::LevelError measure(const pack::PackLevel& level, const image::Image8& texture,
                                       const glm::dvec3& box_size, const SourceScene& source,
                                       const SourceSamples& samples, bool compare_colour);

/// The first hit of a ray on a surface that may have invisible parts.
using TraceSurface = std::function<SurfaceHit(const glm::vec3& eye, const glm::vec3& direction)>;
/// The error of the pack's levels and reliefs as seen by eyes all around: rays from each eye against the
/// source. The eyes are spread evenly over the zone, except for its edge, where visitors hardly stand.
/// `share`: of the usual number of rays.
[[nodiscard]] pack::SeenErrors seen_errors(const pack::Pack& pack,
                                           std::span<const pack::MeasuredRelief> reliefs,
                                           const SourceScene& source, const ViewingZone& zone,
                                           double share = 1.0);
/// The means over all eyes: with a single eye, one strap would change the figures too much.
[[nodiscard]] pack::SeenError mean_of(std::span<const pack::SeenError> seen);
/// Distances in both directions, as in measure_shape, between points hit by rays from eyes of the zone: from
/// the source's hits to the surface, and from the hits of `trace` to the source. Invisible parts do not
/// count. Colour is left at 0.
[[nodiscard]] pack::LevelError seen_distances(const SourceScene& surface, const TraceSurface& trace,
                                              const SourceScene& source, const glm::dvec3& box_size,
                                              const ViewingZone& zone, double share = 1.0);
/// True if a visitor would take the level for the source, and no part of it is missing.
[[nodiscard]] bool good_enough(const pack::LevelError& measured, const pack::SeenError& seen,
                               double mm_per_box);

/// Samples a pixel (2, 4 or 8) for pictures of the source at the resolution of a usual table: the fewest that
/// stay within a modest colour error of 16 samples, and no more than a slow GPU shades in time. Plain bodies
/// need two, thin or finely painted ones more. `share`: of the pixel rows that are measured.
[[nodiscard]] int samples_needed(const SourceScene& source, const glm::dvec3& box_size, double mm_per_box,
                                 const ViewingZone& zone, double share = 1.0);

} // namespace frustumscreen::bake
