/// The curves of a pack's behaviours, as the bytes of their part. FORMAT.md defines them.
///
/// Errors   `decode_curves` takes outside bytes: one line, without the part's name (the caller knows it). Every count is
///          checked before memory is allocated for it. Times and values are checked with the behaviours (check_world.h).
/// Threads  pure; any.
#pragma once

#include "app/world/behaviour.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen::pack {

struct StoredCurve {
    world::Curve curve;
    std::uint16_t components = 3; ///< of a value: 4 for a rotation; of three, the fourth is 0

    [[nodiscard]] bool operator==(const StoredCurve&) const = default;
};

/// Numbers of a value on this path.
[[nodiscard]] inline std::uint16_t components_of(world::Path path) {
    return path == world::Path::Rotation ? 4 : 3;
}
/// Values for each key.
[[nodiscard]] inline std::size_t values_per_key(world::Interpolation interpolation) {
    return interpolation == world::Interpolation::CubicSpline ? 3 : 1;
}

/// Each curve must have as many values as its keys need.
[[nodiscard]] Bytes encode_curves(std::span<const StoredCurve> curves);
[[nodiscard]] Result<std::vector<StoredCurve>> decode_curves(std::span<const std::byte> bytes);

} // namespace frustumscreen::pack
