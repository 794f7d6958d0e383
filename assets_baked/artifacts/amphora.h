/// A neck-amphora of about 330 mm: two reeded handles, hollow mouth, black-figure painting in shallow relief.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <cstdint>

namespace frustumscreen::artifacts {

[[nodiscard]] bake::SourceMesh make_amphora(std::int64_t triangles);

} // namespace frustumscreen::artifacts
