/// Judges what visitors get from the settings: whether text is readable, where captions fit, where artifacts are seen
/// whole, whether the exhibit speaks their languages, when it is open; and lists what to look into.
///
/// Reads the packs and words that the settings name. A file that cannot be read is reported and not judged.
///
/// Units    metres on the table.
/// Time     `now`: start of the week that is judged.
/// Threads  pure but for files; any. Takes about a second.
/// Errors   none: every problem is a sentence of the page.
#pragma once

#include "app/settings/settings.h"

#include <chrono>
#include <string>

namespace frustumscreen::programs {

[[nodiscard]] std::string judgement_page(const settings::Settings& settings, std::chrono::sys_seconds now);

} // namespace frustumscreen::programs
