/// All the peers that show relief images, made from one cast of the images.
///
/// Errors   any error from making a technique.
/// Threads  the one whose context is current; the kiosk must outlive the techniques.
#pragma once

#include "app/bench/techniques/technique.h"
#include "app/bench/truth/truth.h"

#include <memory>
#include <vector>

namespace frustumscreen::bench {

struct ReliefPeer {
    std::unique_ptr<Technique> technique;
    std::uint64_t triangles = 0; ///< drawn as a mesh; 0 if the shader marches
};

/// `texels`: side of a relief image, a power of two.
[[nodiscard]] Result<std::vector<ReliefPeer>> make_relief_peers(const Kiosk& kiosk, const Truth& truth,
                                                                const bake::SourceMesh& mesh,
                                                                const glm::dmat4& prop_from_artifact,
                                                                int texels);

} // namespace frustumscreen::bench
