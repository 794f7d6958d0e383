/// Checks that settings which are each valid also fit together.
///
/// Errors   one line, with the line of the key if the file has it; nothing if the settings fit.
/// Threads  pure; any.
#pragma once

#include "app/settings/settings.h"
#include "app/settings/table_reader.h"

#include <optional>
#include <string>

namespace frustumscreen::settings {

[[nodiscard]] std::optional<Error> unfit(const Settings& settings, const std::string& file,
                                         const KeyLines& lines);

} // namespace frustumscreen::settings
