/// What visitors get from these settings, judged: whether they can read, where captions find room, where the artifacts are seen
/// whole, whether the exhibit speaks their languages, when it is open; and what to look into.
///
/// Packs and words that the settings name are read. What cannot be read is not judged, and that is said.
///
/// Units    metres on the table.
/// Time     `now`: for the week that begins with it.
/// Threads  pure but for files; any. Takes about a second.
/// Errors   none: everything is a sentence.
#pragma once

#include "app/settings/settings.h"

#include <chrono>
#include <string>

namespace frustumscreen {

[[nodiscard]] std::string judgement_page(const Settings& settings, std::chrono::sys_seconds now);

} // namespace frustumscreen
