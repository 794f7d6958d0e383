/// Reduces the triangles of a surface without losing thin parts.
///
/// Frame    box.
/// Threads  uses all cores; deterministic.
/// Library  meshoptimizer (Garland & Heckbert 1997 quadrics).
#pragma once

#include "assets_baked/bake/triangle_mesh.h"

namespace frustumscreen::bake {

/// Largest distance of the mesh's corners from its simplified surface, in tolerances.
inline constexpr float max_tolerances_lost = 8.0F;

/// The fewest triangles that meshoptimizer reaches within `tolerance_box`, cell by cell, repeated until
/// nothing changes. Its errors are 32-bit and insensitive below about 3e-4 of the mesh's extent: with cells
/// of 0.15 box, the surface strays 20 to 40 % less at the same number of triangles, where a mesh is dense
/// enough. A single run stops early on dense meshes (a source of 4M triangles kept 2.3 times as many as one
/// of 100k). Several runs add up to slightly more than the tolerance; every level is measured afterwards.
///
/// Quadrics are weighted by area, so a blade may shrink to its hilt at no cost, because its tip has hardly
/// any area. Parts that are lost in this way, by more than `max_tolerances_lost`, are put back, simplified
/// by a third of the tolerance. They overlap the remains.
/// Open borders may move, too, unless they stay: where another mesh goes on, no gap may open.
enum class Borders { Move, Stay };
[[nodiscard]] TriangleMesh simplify(const TriangleMesh& mesh, float tolerance_box,
                                    Borders borders = Borders::Move);

} // namespace frustumscreen::bake
