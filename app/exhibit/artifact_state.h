/// States of an artifact: whether it can be shown at once.
///
/// Threads  values; any.
#pragma once

#include <cstdint>

namespace frustumscreen::exhibit {

enum class ArtifactState : std::uint8_t {
    Ready,
    Away,     ///< loaded on request
    Unusable, ///< cannot be shown, is not offered
};

} // namespace frustumscreen::exhibit
