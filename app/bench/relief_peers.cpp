#include "app/bench/relief_peers.h"

#include "app/bench/relief_march.h"
#include "app/bench/relief_warp.h"

namespace frustumscreen {

Result<std::vector<ReliefPeer>> make_relief_peers(const Stage& stage, const Truth& truth,
                                                  const SourceMesh& mesh,
                                                  const glm::dmat4& prop_from_artifact, int texels) {
    const ReliefImages images =
        cast_relief_images(truth, placed_box(mesh, prop_from_artifact), stage.prop, texels);
    std::vector<ReliefPeer> peers;
    Result<void> added;
    const auto add = [&](Result<std::unique_ptr<Technique>> technique, std::uint64_t triangles) {
        if (technique) {
            peers.push_back({std::move(*technique), triangles});
        } else {
            added = tl::unexpected<Error>(technique.error());
        }
        return technique.has_value();
    };
    Result<ReliefWarp> warp = make_relief_warp(stage, images);
    if (!warp) {
        return tl::unexpected<Error>(warp.error());
    }
    const bool all = add(make_linear_march(stage, images, {32, 5}), 0) &&
                     add(make_linear_march(stage, images, {128, 6}), 0) &&
                     add(make_cone_march(stage, images), 0) && add(make_quadtree_march(stage, images), 0) &&
                     add(std::move(warp->technique), warp->triangles);
    if (!all) {
        return tl::unexpected<Error>(added.error());
    }
    return peers;
}

} // namespace frustumscreen
