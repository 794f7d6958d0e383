/// Candidates for heads in a foreground picture: tops that widen downwards like a head, to the neck, the
/// shoulders, or another person.
///
/// Frame    pixels of a small frame, as in pinhole.h; row 0 is at the top, and people are upright.
/// Threads  pure; any.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen::visitor {

struct HeadOutline {
    std::vector<glm::dvec2> edge; ///< ends of the rows of the head's upper part, left and right in turn
    double width = 0.0;           ///< of the widest row
};

/// `foreground`: [height][width], zero or nonzero.
[[nodiscard]] std::vector<HeadOutline> find_head_outlines(std::span<const std::uint8_t> foreground, int width,
                                                          int height);

} // namespace frustumscreen::visitor
