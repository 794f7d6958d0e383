/// A neck-amphora of about 330 mm: two reeded handles, hollow mouth, black-figure painting in shallow relief.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <cstdint>

namespace frustumscreen::artifacts {

[[nodiscard]] bake::SourceMesh make_amphora(std::int64_t triangles);
/// In place of the mesh's texture: the colours as the painter left them.
[[nodiscard]] image::Image8 new_amphora_colours();

} // namespace frustumscreen::artifacts
