/// Vessels of the example hall: a krater, a celadon vase, a porcelain bowl and an oil lamp.
///
/// Frame, threads   as builtin.h.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <cstdint>

namespace frustumscreen::artifacts {

/// A red-figure bell krater, two handles.
[[nodiscard]] bake::SourceMesh make_krater(std::int64_t triangles);
/// A plum vase with carved petals under a green glaze that has crackled.
[[nodiscard]] bake::SourceMesh make_celadon_vase(std::int64_t triangles);
/// White porcelain painted in cobalt.
[[nodiscard]] bake::SourceMesh make_bowl(std::int64_t triangles);
/// A Roman oil lamp of clay: a rosette on its disc, a nozzle, a ring to hold it.
[[nodiscard]] bake::SourceMesh make_lamp(std::int64_t triangles);

} // namespace frustumscreen::artifacts
