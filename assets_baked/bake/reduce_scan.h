/// Reduces a scan of far more triangles than a bake can use, right after it is read, so that neither time nor memory of a
/// bake grow with the scan.
///
/// Method   the cells of a grid (cell_clusters.h), as fine as the wanted number of triangles allows.
/// Error    of points spread over both surfaces, the distance from the other one, held against the scan itself. A bake
///          adds it to the errors of all levels and reliefs.
/// Memory   for each vertex of the scan 4 bytes, 12 where it has texture coordinates; for each wanted triangle about 100.
/// Threads  uses all cores; deterministic.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <cstddef>

namespace frustumscreen {

struct ReduceLimits {
    std::size_t most = 6'000'000;   ///< triangles of a scan that is baked as it is
    std::size_t wanted = 4'000'000; ///< about so many are left of a larger one
    std::size_t samples = 24'000;   ///< points on each surface, for the error
};

/// Sets `reduced_from` of a scan with more triangles than allowed, and notes it for the curator; leaves others as they are.
void reduce_scan(SourceMesh& mesh, const ReduceLimits& limits = {});

} // namespace frustumscreen
