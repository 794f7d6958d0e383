/// The picture in the place of a site's map on the table (Presentation::site_map), as TitleIndex::behaviour.
///
/// Threads  constants.
#pragma once

#include <cstddef>

namespace frustumscreen::exhibit {

/// The map, while the prop shows a part of the site.
inline constexpr std::size_t site_map_title = 0;
/// On the miniature, a window into the marked region, whose number is added.
inline constexpr std::size_t site_preview_title = 1;

} // namespace frustumscreen::exhibit
