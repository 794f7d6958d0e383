/// Cones above the texels of a relief image, which say how far a ray may step.
///
/// A cone stands on the middle of a texel's surface and opens towards the viewer. Its ratio is its radius in
/// image lengths for each box length of height.
///
/// Empty    nothing of the surface is inside: ratio = least over all higher texels of distance / height.
/// Relaxed  a ray that comes down from the cone's axis crosses the surface inside the cone at most once,
///          except at corners of single texels: the least over those higher texels behind which, seen from
///          the axis, the surface falls.
/// Codes    65535 = 1, the widest; rounded down.
/// Threads  uses every core inside.
/// Source   Dummer, Cone step mapping, 2006; Policarpo & Oliveira, GPU Gems 3, ch. 18, 2007. There the
///          relaxed cone is found with rays from the top of the box alone; here it holds for rays from any
///          height above the texel, as the steps of a march need it. Texels are not tried pair by pair: a
///          pyramid of the highest ones leaves out those that cannot narrow the cone.
#pragma once

#include "app/image/image.h"

namespace frustumscreen {

/// `depth`: codes 0..65535 of a box length from the viewer's side; square, a power of two of texels.
[[nodiscard]] Image16 empty_cones(const Image16& depth);
[[nodiscard]] Image16 relaxed_cones(const Image16& depth);

} // namespace frustumscreen
