/// The staff picture, page by page: words and test pictures. Each page says what the buttons do.
///
/// Frames   table T, metres, of the pattern.
/// Threads  as Canvas.
/// Errors   none: text that does not fit is set smaller.
#pragma once

#include "app/exhibit/staff_tool.h"
#include "app/show/staff_facts.h"
#include "app/typography/pattern.h"

namespace frustumscreen::show {

/// The part of the picture below a page's words, which depends on page and light alone.
[[nodiscard]] image::Image8 staff_background(const exhibit::StaffView& view,
                                             const typography::PatternScene& scene,
                                             const typography::Typesetter& typesetter);
/// The page without the prop's edges, which are drawn on top of StaffPage::Place.
[[nodiscard]] image::Image8 staff_picture(const exhibit::StaffView& view, const StaffFacts& facts,
                                          const typography::PatternScene& scene,
                                          const image::Image8& background,
                                          const typography::Typesetter& typesetter);

} // namespace frustumscreen::show
