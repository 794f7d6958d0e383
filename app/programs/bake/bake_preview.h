/// --preview: writes the page beside a pack.
///
/// Errors   one sentence: the page cannot be written, a file with its name is not a page, no OpenGL ES to draw with.
/// Threads  one caller; it holds a GL context while it draws.
#pragma once

#include "app/programs/bake/bake_report.h"
#include "app/programs/bake/bake_request.h"

namespace frustumscreen::programs {

/// Checks, before the work, that the page can be drawn and written. Does nothing if no page is wanted.
[[nodiscard]] Result<void> check_preview(const BakeRequest& request);

/// Draws the page from the written pack. Returns the page's size in bytes; 0 if no page is wanted.
[[nodiscard]] Result<std::uint64_t> write_preview(const BakeRequest& request, const BakeResult& result);

} // namespace frustumscreen::programs
