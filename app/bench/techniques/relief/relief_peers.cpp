#include "app/bench/techniques/relief/relief_peers.h"

#include "app/bench/techniques/peers.h"
#include "app/bench/techniques/relief/relief_march.h"
#include "app/bench/techniques/relief/relief_mesh.h"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace frustumscreen::bench {

Result<std::vector<ReliefPeer>> make_relief_peers(const Kiosk& kiosk, const Truth& truth,
                                                  const bake::SourceMesh& mesh,
                                                  const glm::dmat4& prop_from_artifact, int texels) {
    const ReliefImages images =
        rasterize_relief_images(truth, placed_box(mesh, prop_from_artifact), kiosk.prop, texels);
    std::vector<ReliefPeer> peers;
    std::array<Result<std::unique_ptr<Technique>>, 4> marches{
        make_linear_march(kiosk, images, {32, 5}), make_linear_march(kiosk, images, {128, 6}),
        make_cone_march(kiosk, images), make_quadtree_march(kiosk, images)};
    for (Result<std::unique_ptr<Technique>>& march : marches) {
        TRY_VOID(march);
        peers.push_back({std::move(*march), 0});
    }
    const bake::SourceMesh grids = single_layer_mesh(images, single_layer_tolerance_m);
    TRY(std::shared_ptr<const PeerMesh> warped, PeerMesh::upload(grids, glm::dmat4(1.0), true));
    TRY(std::unique_ptr<Technique> warp,
        make_full_mesh(kiosk, std::move(warped), nullptr, fmt::format("relief warp {}", texels)));
    peers.push_back({std::move(warp), grids.triangles.size()});
    return peers;
}

} // namespace frustumscreen::bench
