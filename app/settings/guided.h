/// What visitors can do with the prop in this set-up: whether they are told what to do, and whether they choose with it;
/// what the staff are told.
///
/// Threads  pure; any.
#pragma once

#include "app/settings/settings.h"

namespace frustumscreen {

/// A prop that is not tracked cannot be moved by anybody.
[[nodiscard]] inline bool guides_visitors(const Settings& settings) {
    return settings.exhibit.guidance && settings.tracker.kind != TrackerKind::None;
}

/// Nor can it be slid onto a picture.
[[nodiscard]] inline bool chooses_on_table(const Settings& settings) {
    return settings.exhibit.table_pictures && settings.tracker.kind != TrackerKind::None;
}

/// The table tells the staff of a stick, in the exhibit's own words.
[[nodiscard]] inline bool tells_of_sticks(const Settings& settings) {
    return !settings.exhibit.words.empty();
}

} // namespace frustumscreen
