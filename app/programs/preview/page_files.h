/// The page's style and scripts, built into the program: page.css, page.js, page_reload.js of this folder.
#pragma once

#include <string_view>

namespace frustumscreen::programs {

[[nodiscard]] std::string_view page_style();
[[nodiscard]] std::string_view page_script();
[[nodiscard]] std::string_view page_reload_script();

} // namespace frustumscreen::programs
