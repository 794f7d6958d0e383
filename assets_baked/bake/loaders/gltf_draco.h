/// KHR_draco_mesh_compression, decoded by the Draco library.
///
/// Errors   throws Refusal. The library gets only streams whose counts were checked (draco_counts.h).
#pragma once

#include "assets_baked/bake/loaders/bytes.h"
#include "assets_baked/bake/loaders/gltf_model.h"

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace frustumscreen::bake {

struct DracoNumbers {
    std::shared_ptr<const std::vector<double>> numbers; ///< as stored: normalised integers stay integers
    std::size_t components = 1;
};

struct DracoMesh {
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< every index is below `points`
    std::size_t points = 0;
    std::map<std::string, DracoNumbers, std::less<>> attributes; ///< one element for each point
};

[[nodiscard]] DracoMesh decode_draco(ByteView stream, const GltfDraco& draco, const std::string& place);

} // namespace frustumscreen::bake
