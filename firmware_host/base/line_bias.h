/// The bias of a button's line while the button is up; the settings and the GPIO chip use these terms.
#pragma once

#include <cstdint>

namespace frustumscreen {

enum class LineBias : std::uint8_t { AsIs, PullUp, PullDown, Disabled };

} // namespace frustumscreen
