/// Checks of a pack beyond its syntax. The writer and the reader ask the same questions, so nothing is
/// written that would be refused.
///
/// Errors   one line: which thing, what it is, what is allowed.
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"
#include "firmware_host/base/result.h"

namespace frustumscreen::pack_format {

/// Title, languages, captions, provenance, kind of prop.
[[nodiscard]] Result<void> check_texts(const Pack& pack);
/// box_size, box_from_file, extremes.
[[nodiscard]] Result<void> check_placement(const Pack& pack);
/// The number of levels, and that the default is one of them; the levels themselves are not needed.
[[nodiscard]] Result<void> check_level_count(const Pack& pack, std::size_t levels);
/// Textures, relief and its charts; the levels are not needed. `Chosen`: an empty texture was not read.
enum class Read { All, Chosen };
[[nodiscard]] Result<void> check_pictures(const Pack& pack, Read read = Read::All);
/// Levels; the pictures must have been checked. `Chosen`: an empty level was not read.
[[nodiscard]] Result<void> check_levels(const Pack& pack, Read read = Read::All);
/// One level's own vertices, indices and clusters.
[[nodiscard]] Result<void> check_mesh(const PackLevel& level);

} // namespace frustumscreen::pack_format
