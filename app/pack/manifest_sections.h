/// Conversion of the manifest's known sections between members of the description and records in the file.
/// FORMAT.md defines their contents.
///
/// Errors   as the manifest: the field's place, what was found, what is allowed.
/// Threads  pure; any.
#pragma once

#include "app/pack/json/json_reader.h"
#include "app/pack/manifest.h"

#include <string_view>
#include <vector>

namespace frustumscreen::pack {

/// True if the description has members for the section of this name.
[[nodiscard]] bool is_known_section(std::string_view name);

/// Reads the known sections into the manifest and keeps the others unchanged.
void take_sections(Refusal& refusal, std::vector<SectionRecord> records, Manifest& manifest);
/// The records of all the manifest's sections, in the names' order. An empty section is left out.
[[nodiscard]] std::vector<SectionRecord> make_sections(const Manifest& manifest);

} // namespace frustumscreen::pack
