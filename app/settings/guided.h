/// Whether visitors are told what to do in this set-up.
///
/// Threads  pure; any.
#pragma once

#include "app/settings/settings.h"

namespace frustumscreen {

/// A prop that is not tracked cannot be moved by anybody.
[[nodiscard]] inline bool guides_visitors(const Settings& settings) {
    return settings.exhibit.guidance && settings.tracker.kind != TrackerKind::None;
}

} // namespace frustumscreen
