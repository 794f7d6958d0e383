/// The staff picture, page by page: words and test pictures. Each page says what the buttons do.
///
/// Frames   table T, metres, of the pattern.
/// Threads  as Canvas.
/// Errors   none: text that does not fit is set smaller.
#pragma once

#include "app/exhibit/staff_tool.h"
#include "app/show/staff_facts.h"
#include "app/typography/pattern.h"

namespace frustumscreen {

/// The part of the picture below a page's words, which depends on page and light alone.
[[nodiscard]] Image8 staff_background(const StaffView& view, const PatternScene& scene,
                                      const Typesetter& typesetter);
/// The page without the prop's edges, which are drawn on top of StaffPage::Place.
[[nodiscard]] Image8 staff_picture(const StaffView& view, const StaffFacts& facts, const PatternScene& scene,
                                   const Image8& background, const Typesetter& typesetter);

} // namespace frustumscreen
