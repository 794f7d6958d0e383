/// Whether an artifact can be shown at once.
///
/// Threads  values; any.
#pragma once

#include <cstdint>

namespace frustumscreen {

enum class ArtifactState : std::uint8_t {
    Ready,
    Away,    ///< it comes if it is wanted
    LeftOut, ///< it cannot be shown, and is not offered
};

} // namespace frustumscreen
