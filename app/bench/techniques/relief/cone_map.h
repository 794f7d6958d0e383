/// Cones above the texels of a relief image; they limit how far a ray may step.
///
/// A cone stands on the middle of a texel's surface and opens towards the viewer. Its ratio is its radius in
/// image lengths per box length of height.
///
/// Empty    no part of the surface is inside: ratio = minimum over all higher texels of distance / height.
/// Relaxed  a ray that descends from the cone's axis crosses the surface inside the cone at most once, except
///          at corners of single texels: the minimum over those higher texels behind which, seen from the
///          axis, the surface falls.
/// Codes    65535 = 1, the widest; rounded down.
/// Threads  uses every core inside.
/// Source   Dummer, Cone step mapping, 2006; Policarpo & Oliveira, GPU Gems 3, ch. 18, 2007. There the
///          relaxed cone is found with rays from the top of the box alone; here it holds for rays from any
///          height above the texel, as required by the steps of a march. Texels are not tried pair by pair: a
///          pyramid of the highest ones skips those that cannot narrow the cone.
#pragma once

#include "app/image/image.h"

namespace frustumscreen::bench {

/// `depth`: codes 0..65535 of a box length from the viewer's side; square, with a power of two texels per
/// side.
[[nodiscard]] image::Image16 empty_cones(const image::Image16& depth);
[[nodiscard]] image::Image16 relaxed_cones(const image::Image16& depth);

} // namespace frustumscreen::bench
