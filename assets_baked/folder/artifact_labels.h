/// Reads words in several languages from a table of artifact.toml: { en = "The handle", de = "Der Henkel" }.
///
/// Errors   in the table's ReadState: a tag that names no language, a language twice, a word that is empty or cannot be
///          shown.
/// Threads  one caller.
#pragma once

#include "app/pack/pack.h"
#include "app/settings/table_reader.h"

#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::folder {

/// Reads a language tag in its usual case; refuses an invalid one.
bool read_language(settings::TableReader& table, std::string_view key, std::string& language);
/// A missing key leaves `labels` empty.
void read_labels(settings::TableReader& table, std::string_view key, std::vector<pack::PackLabel>& labels);

} // namespace frustumscreen::folder
