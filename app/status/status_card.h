/// The status in a few short, plain lines, for a telephone that reads them off the staff's picture and sends them
/// on.
///
///     FrustumScreen 0.1.0, 2026-11-27 21:05
///     The exhibit runs and is well
///     projector: the projector at HDMI-A-1 is lit, 1920 x 1200 at 60 Hz
///
/// Text     ASCII, lines of at most `max_card_line_bytes`; a longer line is cut and ends in "...". Lines that do
///          not fit are left out from the end, and the last line says so.
/// Threads  pure; any.
#pragma once

#include "app/status/status_lines.h"

#include <ctime>
#include <span>
#include <string>
#include <string_view>

namespace frustumscreen::status {

inline constexpr std::size_t max_card_bytes = 900, max_card_line_bytes = 110;

/// `lines`: those of status_lines, and further ones for the card. `now`: the wall clock.
[[nodiscard]] std::string status_card(std::string_view verdict, const StatusReport& status,
                                      std::span<const StatusLine> lines, std::time_t now);

} // namespace frustumscreen::status
