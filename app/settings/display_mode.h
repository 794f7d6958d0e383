/// A projector's mode as a person writes it: "1280x800@60", "1280x800" or "preferred".
/// "Preferred" is the picture's own size if the projector has it, else the projector's preferred mode.
///
/// Threads  values.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen::settings {

struct DisplayMode {
    int width = 0; ///< pixels; 0: "preferred"
    int height = 0;
    double refresh_hz = 0.0; ///< 0: any
};

/// Returns nothing if the text has none of these forms, or is beyond 64 to 8192 pixels and 10 to 480 hertz.
[[nodiscard]] std::optional<DisplayMode> parse_display_mode(std::string_view text);
[[nodiscard]] std::string text_of(const DisplayMode& mode);

} // namespace frustumscreen::settings
