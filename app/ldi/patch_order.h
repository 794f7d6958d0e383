/// The order in which a hemisphere's patches are made: the one that is looked at first, then the others by their angle from there.
///
/// Frames   window (triangle_world.h).
/// Threads  a value; any.
/// Errors   none: an eye without a patch changes nothing.
#pragma once

#include "app/ldi/hemisphere.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <optional>

namespace frustumscreen::ldi {

class PatchOrder {
public:
    explicit PatchOrder(const Hemisphere& hemisphere) : hemisphere_(hemisphere) {}

    [[nodiscard]] const Hemisphere& hemisphere() const { return hemisphere_; }
    /// Returns the eye's patch.
    std::optional<std::size_t> look_from(const glm::dvec3& eye);
    /// The first patch that is not made.
    [[nodiscard]] std::optional<std::size_t> next(const std::array<bool, patch_count>& made) const;

private:
    Hemisphere hemisphere_;
    glm::dvec3 looking_from_{0.0, 0.0, 1.0}; ///< direction
};

} // namespace frustumscreen::ldi
