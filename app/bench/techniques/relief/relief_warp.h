/// The peer of the papers: single-layer relief textures warped onto the prop's faces (relief_mesh.h).
///
/// Threads  the one whose context is current; the stage must outlive the technique, the images need not.
#pragma once

#include "app/bench/techniques/relief/relief_images.h"
#include "app/bench/techniques/technique.h"

#include <memory>

namespace frustumscreen {

struct ReliefWarp {
    std::unique_ptr<Technique> technique;
    std::uint64_t triangles = 0;
};
[[nodiscard]] Result<ReliefWarp> make_relief_warp(const Stage& stage, const ReliefImages& images);

} // namespace frustumscreen
