/// Which peers a pack's levels are compared with, as `--peers` names them.
///
/// mesh          the full mesh through the collineation
/// two-pass      the full mesh by the two-pass method
/// ray-cast      the full mesh by a ray cast on the CPU
/// lod           simplified meshes through the collineation
/// two-pass-lod  simplified meshes by the two-pass method
/// relief        relief images: linear, cone-stepping and quadtree marches, and the warp
/// relief-cast   layered relief as the pack holds it, at sizes that it does not hold
/// relief-gpu    the pack's layered reliefs, drawn by the GPU and not cast
///
/// Threads  values; any.
/// Errors   a name that is none of these.
#pragma once

#include "firmware_host/base/result.h"

#include <cstddef>
#include <string_view>
#include <vector>

namespace frustumscreen {

struct PeerChoice {
    bool mesh = true;
    bool two_pass = true;
    bool ray_cast = true;
    bool lod = true;
    bool two_pass_lod = true;
    bool relief = true;
    bool relief_cast = true;
    bool relief_gpu = true;
    /// A pixel; each peer but the relief's is there once with each. None: one, and what the pack asks for.
    std::vector<int> samples;
    std::vector<int> eye_pixels = {640, 1024, 1600}; ///< of the two-pass methods
    std::vector<std::size_t> lod_triangles = {10'000, 20'000, 40'000, 80'000};
    int relief_texels = 512; ///< a side of each relief image
    std::vector<int> cast_texels = {256, 512};
};

/// `words`: none, all, or names with commas between them.
[[nodiscard]] Result<PeerChoice> parse_peers(std::string_view words);

} // namespace frustumscreen
