/// Checks of a pack beyond its syntax. The writer and the reader share them, so a pack that would be refused is
/// never written.
///
/// Errors   one line: which item, its value, what is allowed.
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"
#include "firmware_host/base/result.h"

#include <string>
#include <vector>

namespace frustumscreen::pack {

/// All checks below except those of levels and pictures.
[[nodiscard]] Result<void> check_description(const PackDescription& pack);
/// Id, title, languages, captions, provenance, kind of prop.
[[nodiscard]] Result<void> check_texts(const PackDescription& pack);
/// box_size, box_from_file, extremes.
[[nodiscard]] Result<void> check_placement(const PackDescription& pack);
/// The sections without members in the description.
[[nodiscard]] Result<void> check_sections(const PackDescription& pack);
/// `box_size` must have been checked.
[[nodiscard]] Result<void> check_hotspots(const PackDescription& pack);
/// One line for each language; `place` names the labelled item.
[[nodiscard]] Result<void> check_labels(const std::string& place, const std::vector<PackLabel>& labels);
/// Checks the number of levels, and that the default is one of them; needs no levels.
[[nodiscard]] Result<void> check_level_count(const PackDescription& pack, std::size_t levels);
/// Textures, relief and its charts, the table picture; needs no levels. `Chosen`: an empty texture was not read.
enum class Read { All, Chosen };
[[nodiscard]] Result<void> check_pictures(const Pack& pack, Read read = Read::All);
[[nodiscard]] Result<void> check_table_picture(const image::Image8& picture);
/// Levels; the pictures must have been checked. `Chosen`: an empty level was not read.
[[nodiscard]] Result<void> check_levels(const Pack& pack, Read read = Read::All);
/// Checks cluster number `k` alone; its indices must begin at `first`.
[[nodiscard]] Result<void> check_cluster(const PackCluster& cluster, std::size_t k, std::uint64_t first);
/// Checks one level's own vertices, indices and clusters.
[[nodiscard]] Result<void> check_mesh(const PackLevel& level);

} // namespace frustumscreen::pack
