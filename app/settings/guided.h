/// The use that visitors make of the prop in this set-up: whether there is guidance, and whether they choose with the
/// prop; also what the staff are told.
///
/// Threads  pure; any.
#pragma once

#include "app/settings/settings.h"

namespace frustumscreen::settings {

/// A prop that is not tracked cannot be moved, so there is nothing to advise.
[[nodiscard]] inline bool guides_visitors(const Settings& settings) {
    return settings.exhibit.guidance && settings.tracker.kind != TrackerKind::None;
}

/// A prop that is not tracked cannot be slid onto a picture either.
[[nodiscard]] inline bool chooses_on_table(const Settings& settings) {
    return settings.exhibit.table_pictures && settings.tracker.kind != TrackerKind::None;
}

/// The table reports a stick to the staff if the exhibit has words of its own.
[[nodiscard]] inline bool tells_of_sticks(const Settings& settings) {
    return !settings.exhibit.words.empty();
}

} // namespace frustumscreen::settings
