/// The page beside a pack: --preview.
///
/// Errors   one sentence: a page that cannot be written, a file in its place that is no page, no OpenGL ES to draw with.
/// Threads  one caller; it holds a GL context while it draws.
#pragma once

#include "app/programs/bake/bake_report.h"
#include "app/programs/bake/bake_request.h"

namespace frustumscreen {

/// Before the work. Nothing is checked without a page to write.
[[nodiscard]] Result<void> check_preview(const BakeRequest& request);

/// From the pack that was written; the page's size in bytes, 0 without a page to write.
[[nodiscard]] Result<std::uint64_t> write_preview(const BakeRequest& request, const BakeResult& result);

} // namespace frustumscreen
