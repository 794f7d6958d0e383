/// The reference: the full source mesh by ray casting on the CPU, straight into the framebuffer.
///
/// Rays     for each face a pixel's ray from the eye is linear in the pixel (64-bit set-up); packets of 8
///          along rows, only of pixels that may show the artifact's box. Embree's kernels, 32-bit, every
///          core.
/// Colour   as the truth's one ray: bilinear, base level; several samples a pixel, a ray each, are averaged in linear light as they
///          come.
/// Threads  the one whose context is current; the rays are cast on every core.
#pragma once

#include "app/bench/techniques/peer_gl.h"
#include "app/bench/truth/traced_mesh.h"

#include <memory>

namespace frustumscreen {

/// The stage must outlive the technique.
[[nodiscard]] Result<std::unique_ptr<Technique>>
make_ray_cast(const Stage& stage, std::shared_ptr<const TracedMesh> mesh, int samples = 1);

} // namespace frustumscreen
