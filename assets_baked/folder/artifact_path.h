/// Reads a path inside a curator's folder; a file outside it would not move with the folder.
///
/// Errors   in the table's ReadState.
/// Threads  one caller.
#pragma once

#include "app/settings/table_reader.h"

#include <filesystem>
#include <string_view>

namespace frustumscreen::folder {

/// A missing key, and an empty text, leave `value` as it is.
void read_path(settings::TableReader& table, std::string_view key, std::filesystem::path& value);

} // namespace frustumscreen::folder
