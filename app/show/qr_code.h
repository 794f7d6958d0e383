/// A text as a QR code (ISO/IEC 18004): a picture of its modules, dark on light, with the quiet zone of four modules.
///
/// Text     raw bytes, which readers interpret as UTF-8. At most `max_qr_bytes`.
/// Repair   level M: up to 15 % of the code may be unreadable, for example under a cable.
/// Threads  pure; any.
/// Errors   a text that is too long or empty gives an empty picture.
/// Library  libqrencode 4.
#pragma once

#include "app/image/image.h"

#include <cstdint>
#include <string_view>

namespace frustumscreen::show {

inline constexpr std::size_t max_qr_bytes = 2000;

/// One pixel a module; 0 is dark, 255 is light.
[[nodiscard]] image::Image<std::uint8_t> qr_code(std::string_view text);

} // namespace frustumscreen::show
