/// A box face that a relief's rays start from: its axes and its sign, as in ReliefDirection.
///
/// Frame    box.
/// Threads  values.
#pragma once

#include "app/pack/pack.h"

#include <glm/glm.hpp>

namespace frustumscreen::bake {

struct DirectionFrame {
    int axis_u, axis_v, axis_n;
    float sign;

    [[nodiscard]] glm::vec3 normal() const {
        glm::vec3 n(0.0F);
        n[axis_n] = sign;
        return n;
    }
};

[[nodiscard]] constexpr DirectionFrame frame_of(pack::ReliefDirection direction) {
    const float sign = direction == pack::ReliefDirection::PlusX ||
                               direction == pack::ReliefDirection::PlusY ||
                               direction == pack::ReliefDirection::PlusZ
                           ? 1.0F
                           : -1.0F;
    switch (direction) {
    case pack::ReliefDirection::PlusX:
    case pack::ReliefDirection::MinusX:
        return {.axis_u = 1, .axis_v = 2, .axis_n = 0, .sign = sign};
    case pack::ReliefDirection::PlusY:
    case pack::ReliefDirection::MinusY:
        return {.axis_u = 0, .axis_v = 2, .axis_n = 1, .sign = sign};
    default:
        return {.axis_u = 0, .axis_v = 1, .axis_n = 2, .sign = sign};
    }
}

} // namespace frustumscreen::bake
