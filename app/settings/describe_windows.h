/// The settings of windows on the table, described as describe_settings.h describes the others.
///
/// Threads  pure; any.
#pragma once

#include "app/settings/range.h"
#include "app/settings/settings.h"

#include <cstddef>

namespace frustumscreen::settings {

template <typename Fields> void window_settings(Fields& fields, auto& windows) {
    int count = static_cast<int>(windows.count);
    fields.integer(
        "count", count, 0, static_cast<int>(max_windows),
        "how many lie on the table at once; the oldest goes for another one. 0: none can be pinned");
    if constexpr (Fields::reads) {
        windows.count = static_cast<std::size_t>(count);
    }
    constexpr Range side{0.04, 0.4, "metres"};
    fields.number("width_m", windows.width_m, side, "of each, as its visitor sees it");
    fields.number("depth_m", windows.depth_m, side, "of each, away from the visitor");
    fields.flag("live", windows.live,
                "behaviours and torches go on in windows; otherwise a window is frozen when it is pinned");
}

} // namespace frustumscreen::settings
