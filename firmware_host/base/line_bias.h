/// What holds a button's line while the button is up: the word of the settings and of the GPIO chip.
#pragma once

#include <cstdint>

namespace frustumscreen {

enum class LineBias : std::uint8_t { AsIs, PullUp, PullDown, Disabled };

} // namespace frustumscreen
