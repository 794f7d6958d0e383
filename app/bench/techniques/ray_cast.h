/// The reference: the full source mesh by ray casting on the CPU, directly into the framebuffer.
///
/// Rays     on each face a pixel's ray from the eye is linear in the pixel (64-bit set-up); packets of 8
///          along rows, only for pixels that may show the artifact's box. Embree's kernels, 32-bit, every
///          core.
/// Colour   like the truth's single ray: bilinear, base level; with several samples per pixel, one ray each,
///          averaged in linear light.
/// Threads  the one whose context is current; the rays are cast on every core.
#pragma once

#include "app/bench/techniques/peer_gl.h"
#include "app/bench/truth/traced_mesh.h"

#include <memory>

namespace frustumscreen::bench {

/// The kiosk must outlive the technique.
[[nodiscard]] Result<std::unique_ptr<Technique>>
make_ray_cast(const Kiosk& kiosk, std::shared_ptr<const TracedMesh> mesh, int samples = 1);

} // namespace frustumscreen::bench
