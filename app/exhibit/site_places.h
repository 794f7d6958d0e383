/// Values of TitleIndex::behaviour that say which picture lies in the place of a site's map (Presentation::site_map).
///
/// Threads  constants.
#pragma once

#include <cstddef>

namespace frustumscreen::exhibit {

/// The map, while the prop shows a part of the site.
inline constexpr std::size_t site_map_title = 0;
/// A window into the marked region, while the prop shows the miniature; the region's number is added.
inline constexpr std::size_t site_preview_title = 1;

} // namespace frustumscreen::exhibit
