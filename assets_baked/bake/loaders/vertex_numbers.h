/// Numbers for the different vertices of a file.
#pragma once

#include "assets_baked/bake/key_numbers.h"

namespace frustumscreen::bake {

/// The key of a vertex: the file's numbers of its position, texture coordinate and normal, or the bits of its position.
using VertexNumbers = KeyNumbers<3>;

} // namespace frustumscreen::bake
