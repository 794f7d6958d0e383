/// A box face that a relief's rays start from: its axes and its sign, as in ReliefDirection.
///
/// Frame    box.
/// Threads  values.
#pragma once

#include "app/pack/pack.h"

#include <glm/glm.hpp>

namespace frustumscreen {

struct DirectionFrame {
    int axis_u, axis_v, axis_n;
    float sign;

    [[nodiscard]] glm::vec3 normal() const {
        glm::vec3 n(0.0F);
        n[axis_n] = sign;
        return n;
    }
};

[[nodiscard]] constexpr DirectionFrame frame_of(ReliefDirection direction) {
    const float sign = direction == ReliefDirection::PlusX || direction == ReliefDirection::PlusY ||
                               direction == ReliefDirection::PlusZ
                           ? 1.0F
                           : -1.0F;
    switch (direction) {
    case ReliefDirection::PlusX:
    case ReliefDirection::MinusX:
        return {1, 2, 0, sign};
    case ReliefDirection::PlusY:
    case ReliefDirection::MinusY:
        return {0, 2, 1, sign};
    default:
        return {0, 1, 2, sign};
    }
}

} // namespace frustumscreen
