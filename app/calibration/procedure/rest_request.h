/// Chooses where the board should stand next, and how: spread over the picture, every fourth rest leaning, on
/// a block if the prop's top shows no tag.
///
/// Frames   pixels of the projector.
/// Threads  pure; any.
#pragma once

#include "app/calibration/procedure/rest_posture.h"
#include "app/calibration/rest.h"

#include <span>

namespace frustumscreen::calibration {

struct TakenRest {
    Rest rest;
    Posture posture = Posture::Flat;
    bool has_top = false; ///< the tag on the prop's top was seen
};

struct RestRequest {
    Posture posture = Posture::Flat;
    glm::dvec2 pixel{0.0}; ///< approximate place for the prop's middle
};
/// The first `first_flat` rests should be flat; they determine the table's normal. `size_px`: of the
/// projector's picture.
inline constexpr std::size_t first_flat = 3;
[[nodiscard]] RestRequest next_request(std::span<const TakenRest> taken, const glm::dvec2& size_px);

[[nodiscard]] std::size_t count_of(std::span<const TakenRest> taken, Posture posture);

} // namespace frustumscreen::calibration
