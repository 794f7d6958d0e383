/// Relief textures, warped as by Oliveira, Bishop & McAllister and projected on a prop as by Kim, Shin & Kim:
/// each single-layer image's texels are mapped from their depth to where the eye sees them on the prop's
/// face.
///
/// Their pre-warp sends texel (u, v) of depth d to (u', v') = (linear in u, v, d) / (linear in u, v, d): the
/// collineation of the face and the eye, restricted to the image's texels. The images are therefore drawn as
/// grids of triangles through each face's collineation, which fills the holes between texels and warps them
/// exactly; it replaces two passes of 1-D resampling over each image on the CPU and the subsequent texture
/// mapping. Flat parts of a grid are simplified to a tolerance; this determines the speed, because a driver's
/// time grows with the triangles.
///
/// Single   triangles across a jump of depth are left out; surfaces that no image sees first are missing. If
///          another image sees a surface more nearly along its normal and shows it, only that image draws it.
/// Frame    the mesh in the prop's frame, metres; one material and texture per image.
/// Threads  `single_layer_mesh` any; the technique as peers.h.
/// Source   Oliveira, Bishop & McAllister, Relief texture mapping, 2000; Kim, Shin & Kim 2008.
#pragma once

#include "app/bench/techniques/relief/relief_images.h"

namespace frustumscreen::bench {

inline constexpr double single_layer_tolerance_m = 1e-4;

[[nodiscard]] bake::SourceMesh single_layer_mesh(const ReliefImages& images, double tolerance_m);

} // namespace frustumscreen::bench
