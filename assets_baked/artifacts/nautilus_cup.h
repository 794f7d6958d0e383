/// A nautilus cup: a thin, pearly shell, open to its coil, on a gilded stem. About 260 mm high.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <cstdint>

namespace frustumscreen::artifacts {

[[nodiscard]] bake::SourceMesh make_nautilus_cup(std::int64_t triangles);

} // namespace frustumscreen::artifacts
