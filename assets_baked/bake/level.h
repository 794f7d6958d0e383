/// Makes a level of the pack from charted triangles: quantised, ordered for the vertex cache, cut into
/// clusters, measured.
///
/// Frame    box.
/// Threads  pure; any (measure uses all cores).
/// Library  meshoptimizer (meshlets and their normal cones).
#pragma once

#include "app/pack/pack.h"
#include "app/pack/pack_relief.h"
#include "app/pack/seen_errors.h"
#include "assets_baked/bake/charts.h"
#include "assets_baked/bake/source_scene.h"
#include "assets_baked/bake/visibility.h"

#include <functional>
#include <span>

namespace frustumscreen {

/// Level with vertices, indices and clusters; texture and error are left to the caller.
[[nodiscard]] PackLevel make_level(const ChartedMesh& mesh, const glm::dvec3& box_size);

/// The mesh as a level would hold it: with its positions rounded to the pack's codes.
[[nodiscard]] TriangleMesh on_codes(TriangleMesh mesh, const glm::dvec3& box_size);

/// Rebuilds a level's surface from its quantised vertices.
[[nodiscard]] TriangleMesh surface_of(const PackLevel& level, const glm::dvec3& box_size);

/// The same with its texture, for ray casts; where the texture's alpha cuts, rays pass. `texture` must outlive it.
[[nodiscard]] SourceMesh textured_source(const PackLevel& level, const Image8& texture,
                                         const glm::dvec3& box_size);

/// Points on the source that a visitor sees, with their colour: chosen once, compared with every level.
struct SourceSamples {
    struct Point {
        glm::vec3 position{0.0F};
        glm::vec3 normal{0.0F}; ///< of the side that is seen
        glm::vec3 colour{0.0F}; ///< linear
    };
    std::vector<Point> points;
    /// Corners of the seen surface. Thin parts have hardly any area, and so few points, but they have corners.
    std::vector<glm::vec3> corners;
    double share = 1.0; ///< of the usual number of points
};
/// `visible` is the kept surface of the finest level: only source points near it are chosen.
[[nodiscard]] SourceSamples sample_source(const SourceScene& source, const TriangleMesh& visible,
                                          float tolerance_box, double share = 1.0);

/// Measures both ways: the surface's points against the source, the source's seen points against the surface. The
/// greatest distance also counts the source's corners. Colour is left at 0.
[[nodiscard]] LevelError measure_shape(const TriangleMesh& surface, const SourceScene& source,
                                       const SourceSamples& samples);
/// RMSE over the source's seen points, in 8-bit codes. It says something of unlit textures alone: baked light is not
/// an error.
[[nodiscard]] float measure_colour(const PackLevel& level, const Image8& texture, const glm::dvec3& box_size,
                                   const SourceSamples& samples);
/// Both.
[[nodiscard]] LevelError measure(const PackLevel& level, const Image8& texture, const glm::dvec3& box_size,
                                 const SourceScene& source, const SourceSamples& samples,
                                 bool compare_colour);

/// The first hit of a ray on a surface of which not every place is drawn.
using TraceSurface = std::function<SurfaceHit(const glm::vec3& eye, const glm::vec3& direction)>;
/// What eyes all around see of the pack's levels, and of the reliefs: rays from each eye against the source. The eyes are spread
/// evenly over the zone; hardly anybody stands at its edge. `share`: of the usual number of rays.
[[nodiscard]] SeenErrors seen_errors(const Pack& pack, std::span<const MeasuredRelief> reliefs,
                                     const SourceScene& source, const ViewingZone& zone, double share = 1.0);
/// The means over all eyes: with one, a single strap would change the figures too much.
[[nodiscard]] SeenError mean_of(std::span<const SeenError> seen);
/// Distances both ways, as measure_shape, of what rays from eyes of the zone meet: from the source's hits to the surface, and from
/// what `trace` meets to the source. What no eye sees does not count. Colour is left at 0.
[[nodiscard]] LevelError seen_distances(const SourceScene& surface, const TraceSurface& trace,
                                        const SourceScene& source, const glm::dvec3& box_size,
                                        const ViewingZone& zone, double share = 1.0);
/// Whether a visitor would take the level for the source, and no part of it is lost.
[[nodiscard]] bool good_enough(const LevelError& measured, const SeenError& seen, double mm_per_box);

/// Samples a pixel (2, 4 or 8) for pictures of the source at the resolution of a usual table: the fewest that
/// stay within a modest colour error of 16 samples, and no more than a slow GPU shades in time. Plain bodies
/// need two, thin or finely painted ones more. `share`: of the pixels' rows, which are looked at.
[[nodiscard]] int samples_needed(const SourceScene& source, const glm::dvec3& box_size, double mm_per_box,
                                 const ViewingZone& zone, double share = 1.0);

} // namespace frustumscreen
