// glTF and GLB, including Draco and meshoptimizer.
#include "tests/fuzz/mesh_check.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return frustumscreen::fuzz::check_mesh(data, size, "model.gltf");
}
