/// Every setting as a page of Markdown: docs/settings.md, for `frustumscreen config --describe`.
///
/// Threads  pure; any.
#pragma once

#include <string>

namespace frustumscreen::settings {

[[nodiscard]] std::string settings_page();

} // namespace frustumscreen::settings
