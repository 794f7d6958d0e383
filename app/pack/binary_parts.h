/// The binary parts of a pack: a level's triangles, the relief's charts. FORMAT.md defines the bytes.
///
/// Errors   one line, without the part's name (the caller knows it).
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace frustumscreen::pack {

/// Vertices, indices and clusters. A relief level's vertices are stored as texels of `relief`; a vertex is refused
/// unless it is at the centre of a filled texel of a chart, at the place that the relief gives it.
[[nodiscard]] Result<Bytes> encode_level(const PackLevel& level, const ReliefAtlas& relief,
                                         const glm::dvec3& box_size);
/// Technique, vertices, indices, clusters. `relief` and `box_size` must have been checked.
[[nodiscard]] Result<PackLevel> decode_level(std::span<const std::byte> bytes, const ReliefAtlas& relief,
                                             const glm::dvec3& box_size);

/// Checks, as the bytes pass and without keeping them, that a level's part can be decoded. The places of a relief
/// level's vertices are not checked, because that needs the relief.
class LevelScan {
public:
    explicit LevelScan(std::uint64_t part_bytes) : part_bytes_(part_bytes) {}
    void add(std::span<const std::byte> bytes);
    /// Call once, last. `technique`, `triangles` and `vertices`: from the manifest.
    [[nodiscard]] Result<void> finish(LevelTechnique technique, std::uint64_t triangles,
                                      std::uint64_t vertices) const;

private:
    [[nodiscard]] std::size_t next_bytes() const;
    void take(std::span<const std::byte> item);
    std::uint64_t part_bytes_;
    Bytes begun_; ///< the beginning of the next item
    bool has_header_ = false, is_relief_ = false;
    std::uint32_t vertices_ = 0, indices_ = 0, clusters_ = 0;
    std::uint32_t clusters_seen_ = 0, indices_seen_ = 0, vertices_seen_ = 0;
    std::uint64_t covered_ = 0; ///< indices covered by clusters
    std::optional<Error> fault_;
};

[[nodiscard]] Bytes encode_charts(const std::vector<ReliefChart>& charts);
[[nodiscard]] Result<std::vector<ReliefChart>> decode_charts(std::span<const std::byte> bytes);

} // namespace frustumscreen::pack
