/// Checks of a pack beyond its syntax. The writer and the reader ask the same questions, so nothing is
/// written that would be refused.
///
/// Errors   one line: which thing, what it is, what is allowed.
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"
#include "firmware_host/base/result.h"

#include <string>
#include <vector>

namespace frustumscreen::pack_format {

/// All that follow but the levels and the pictures.
[[nodiscard]] Result<void> check_description(const PackDescription& pack);
/// Id, title, languages, captions, provenance, kind of prop.
[[nodiscard]] Result<void> check_texts(const PackDescription& pack);
/// box_size, box_from_file, extremes.
[[nodiscard]] Result<void> check_placement(const PackDescription& pack);
/// The sections that the description has no members for.
[[nodiscard]] Result<void> check_sections(const PackDescription& pack);
/// box_size must have been checked.
[[nodiscard]] Result<void> check_hotspots(const PackDescription& pack);
/// One line for each language; `place` names what they label.
[[nodiscard]] Result<void> check_labels(const std::string& place, const std::vector<PackLabel>& labels);
/// The number of levels, and that the default is one of them; the levels themselves are not needed.
[[nodiscard]] Result<void> check_level_count(const PackDescription& pack, std::size_t levels);
/// Textures, relief and its charts, the table's picture; the levels are not needed. `Chosen`: an empty texture was not read.
enum class Read { All, Chosen };
[[nodiscard]] Result<void> check_pictures(const Pack& pack, Read read = Read::All);
[[nodiscard]] Result<void> check_table_picture(const Image8& picture);
/// Levels; the pictures must have been checked. `Chosen`: an empty level was not read.
[[nodiscard]] Result<void> check_levels(const Pack& pack, Read read = Read::All);
/// Cluster number `k` alone, whose indices begin at `first`.
[[nodiscard]] Result<void> check_cluster(const PackCluster& cluster, std::size_t k, std::uint64_t first);
/// One level's own vertices, indices and clusters.
[[nodiscard]] Result<void> check_mesh(const PackLevel& level);

} // namespace frustumscreen::pack_format
