/// Checks whether settings that are right one by one also fit together.
///
/// Errors   one line, with the line of the key where the file names it; nothing if all is well.
/// Threads  pure; any.
#pragma once

#include "app/settings/settings.h"
#include "app/settings/table_reader.h"

#include <optional>
#include <string>

namespace frustumscreen {

[[nodiscard]] std::optional<Error> unfit(const Settings& settings, const std::string& file,
                                         const KeyLines& lines);

} // namespace frustumscreen
