/// The peers that a pack's levels are compared with, as named by `--peers`.
///
/// mesh          the full mesh through the collineation
/// two-pass      the full mesh by the two-pass method
/// ray-cast      the full mesh by a ray cast on the CPU
/// lod           simplified meshes through the collineation
/// two-pass-lod  simplified meshes by the two-pass method
/// relief        relief images: linear, cone-stepping and quadtree marches, and the warp
/// relief-cast   layered relief like the pack's, at sizes that the pack does not contain
/// relief-gpu    the pack's layered reliefs, drawn by the GPU instead of rasterized
///
/// Threads  values; any.
/// Errors   any other name.
#pragma once

#include "firmware_host/base/result.h"

#include <cstddef>
#include <string_view>
#include <vector>

namespace frustumscreen::bench {

struct PeerChoice {
    bool mesh = true;
    bool two_pass = true;
    bool ray_cast = true;
    bool lod = true;
    bool two_pass_lod = true;
    bool relief = true;
    bool relief_cast = true;
    bool relief_gpu = true;
    /// Per pixel; each peer except the relief's is added once for each number. Empty: one, and the pack's own
    /// number.
    std::vector<int> samples;
    std::vector<int> eye_pixels = {640, 1024, 1600}; ///< of the two-pass methods
    std::vector<std::size_t> lod_triangles = {10'000, 20'000, 40'000, 80'000};
    int relief_texels = 512; ///< side of each relief image
    std::vector<int> cast_texels = {256, 512};
};

/// `words`: none, all, or names separated by commas.
[[nodiscard]] Result<PeerChoice> parse_peers(std::string_view words);

} // namespace frustumscreen::bench
