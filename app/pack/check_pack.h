/// What must hold of a pack besides its syntax. The writer and the reader ask the same questions, so nothing
/// is written that would be refused.
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
/// Textures, relief and its charts; needs nothing of the levels.
[[nodiscard]] Result<void> check_pictures(const Pack& pack);
/// Levels; the pictures are right.
[[nodiscard]] Result<void> check_levels(const Pack& pack);
/// One level's own vertices, indices and clusters.
[[nodiscard]] Result<void> check_mesh(const PackLevel& level);

} // namespace frustumscreen::pack_format
