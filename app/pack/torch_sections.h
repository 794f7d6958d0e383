/// The data of the section `torches`: JSON from and to PackTorches. FORMAT.md defines the fields.
///
/// Parts    the section's parts in order: the pictures, the frames of each film, for each layer its textures and its
///          reliefs. The data gives the counts, so the parts need no names.
/// Errors   one line beginning with the field's place in the manifest.
/// Threads  pure; any.
#pragma once

#include "app/pack/pack_torches.h"
#include "firmware_host/base/result.h"

#include <string>
#include <string_view>

namespace frustumscreen::pack {

inline constexpr std::string_view torches_section = "torches";

/// Syntax, and the number of parts; empty without the section.
[[nodiscard]] Result<PackTorches> read_torch_section(const PackDescription& pack);
[[nodiscard]] std::string write_torches(const PackTorches& torches);

/// Checks contents and sizes against FORMAT.md; needs no part.
[[nodiscard]] Result<void> check_torch_fields(const PackTorches& torches);

} // namespace frustumscreen::pack
