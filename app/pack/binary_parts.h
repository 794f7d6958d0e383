/// The binary parts of a pack: a level's triangles, the relief's charts. FORMAT.md has the bytes.
///
/// Errors   one line, without the part's name (the caller knows it).
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <span>

namespace frustumscreen::pack_format {

/// Vertices, indices and clusters. A relief level's vertices are stored as texels of `relief`; a vertex that
/// is not at the centre of a filled texel of a chart, or not where the relief puts it, is refused.
[[nodiscard]] Result<Bytes> encode_level(const PackLevel& level, const ReliefAtlas& relief,
                                         const glm::dvec3& box_size);
/// Technique, vertices, indices, clusters. `relief` and `box_size` must have been checked.
[[nodiscard]] Result<PackLevel> decode_level(std::span<const std::byte> bytes, const ReliefAtlas& relief,
                                             const glm::dvec3& box_size);

[[nodiscard]] Bytes encode_charts(const std::vector<ReliefChart>& charts);
[[nodiscard]] Result<std::vector<ReliefChart>> decode_charts(std::span<const std::byte> bytes);

} // namespace frustumscreen::pack_format
