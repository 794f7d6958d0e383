/// The counts at the front of a Draco stream. The library allocates as many elements as a stream claims, so the counts
/// are compared with the stream's size before it sees the stream.
///
/// Errors   throws Refusal.
/// Source   Draco 3D Graphics, Bitstream Specification 2.2, "Header", "Metadata", "Connectivity".
#pragma once

#include "assets_baked/bake/loaders/bytes.h"

#include <cstdint>
#include <string>

namespace frustumscreen::bake {

struct DracoCounts {
    std::uint64_t faces = 0;
    std::uint64_t points = 0; ///< for edge breaker connectivity: vertices
};

/// Refuses anything that is not a triangle mesh of bitstream 2.2 with plausible counts.
DracoCounts check_draco_stream(ByteView stream, const std::string& place);

} // namespace frustumscreen::bake
