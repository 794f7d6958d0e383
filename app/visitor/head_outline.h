/// What may be heads in a picture of foreground: tops that grow wider downwards as a head does, to where the neck or the shoulders, or
/// somebody else, begins.
///
/// Frame    pixels of a small frame, as pinhole.h has them; row 0 is at the top, and so are people.
/// Threads  pure; any.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen {

struct HeadOutline {
    std::vector<glm::dvec2> edge; ///< ends of the rows of the head's upper part, left and right in turn
    double width = 0.0;           ///< of the widest of them
};

/// `foreground`: [height][width], 0 or not.
[[nodiscard]] std::vector<HeadOutline> find_head_outlines(std::span<const std::uint8_t> foreground, int width,
                                                          int height);

} // namespace frustumscreen
