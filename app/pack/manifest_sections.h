/// The sections of a manifest that this program knows, between their members in the description and their records
/// in the file. FORMAT.md says what each holds.
///
/// Errors   as the manifest: the field's place, what was found, what is allowed.
/// Threads  pure; any.
#pragma once

#include "app/pack/json/json_reader.h"
#include "app/pack/manifest.h"

#include <string_view>
#include <vector>

namespace frustumscreen::pack_format {

/// Whether the description has members for the section of this name.
[[nodiscard]] bool is_known_section(std::string_view name);

/// Reads the known sections into the manifest and keeps the others as they are.
void take_sections(Refusal& refusal, std::vector<SectionRecord> records, Manifest& manifest);
/// The records of all that a manifest has, in the names' order. A section that says nothing is left out.
[[nodiscard]] std::vector<SectionRecord> make_sections(const Manifest& manifest);

} // namespace frustumscreen::pack_format
