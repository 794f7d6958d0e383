/// The staff's picture, page by page: words, and what is to be looked at. What the buttons do stands on each page.
///
/// Frames   table T, metres, of the pattern.
/// Threads  as Canvas.
/// Errors   none: what does not fit is set smaller.
#pragma once

#include "app/exhibit/staff_tool.h"
#include "app/show/staff_facts.h"
#include "app/typography/pattern.h"

namespace frustumscreen {

/// What lies below a page's words, and follows from page and light alone.
[[nodiscard]] Image8 staff_background(const StaffView& view, const PatternScene& scene,
                                      const Typesetter& typesetter);
/// The page, without the prop's edges, which StaffPage::Place has on top of it.
[[nodiscard]] Image8 staff_picture(const StaffView& view, const StaffFacts& facts, const PatternScene& scene,
                                   const Image8& background, const Typesetter& typesetter);

} // namespace frustumscreen
