/// Where the board is to stand next, and how: spread over the picture, every fourth rest leaning, on a block where the prop's top shows no tag.
///
/// Frames   pixels of the projector.
/// Threads  pure; any.
#pragma once

#include "app/calibration/procedure/rest_posture.h"
#include "app/calibration/rest.h"

#include <span>

namespace frustumscreen {

struct TakenRest {
    Rest rest;
    Posture posture = Posture::Flat;
    bool has_top = false; ///< the tag on the prop's top was seen
};

struct RestWish {
    Posture posture = Posture::Flat;
    glm::dvec2 pixel{0.0}; ///< about where the prop's middle is to be
};
/// The first `first_flat` are to be flat, and tell how the table lies. `size_px`: of the projector's picture.
inline constexpr std::size_t first_flat = 3;
[[nodiscard]] RestWish next_wish(std::span<const TakenRest> taken, const glm::dvec2& size_px);

[[nodiscard]] std::size_t count_of(std::span<const TakenRest> taken, Posture posture);

} // namespace frustumscreen
