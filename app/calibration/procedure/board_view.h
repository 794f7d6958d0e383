/// What the captures of one rest tell of the board: which of its tags are seen whole, lit and undisturbed, and the projector's pixels at their corners.
///
/// Disturbed a bit and its inverse make white and black together, and a cosine's steps make a wave without harmonics above the second (a projector's
///          gamma has hardly any): where something passed through the light, they do not.
/// Units    pixels of the projector and of the camera; metres in the prop's frame.
/// Threads  pure; any.
#pragma once

#include "app/calibration/board.h"
#include "app/calibration/gray_code.h"
#include "app/calibration/rest.h"
#include "firmware_host/tags/tag_detector.h"

#include <span>

namespace frustumscreen {

struct BoardView {
    std::vector<PropPoint> points; ///< four of each tag that counts
    int tags = 0;                  ///< that count
    bool has_top = false;          ///< that of the prop's top counts
    int moved = 0;                 ///< between the white picture before the stripes and the one after them
    int disturbed = 0;             ///< something passed over them meanwhile
    int clipped = 0;               ///< too bright for the camera
};

/// The board's tags among those found; one that is found twice is none.
[[nodiscard]] std::vector<FoundTag> tags_of(const Board& board, std::span<const FoundTag> found);

/// Whether a corner of a tag that both have lies elsewhere; `farthest_px`: on the camera's picture.
[[nodiscard]] bool has_moved(const FoundTag& before, const FoundTag& after, double farthest_px);

/// `before`, `after`: the board's tags in the white pictures before the stripes and after them.
[[nodiscard]] BoardView view_of(const Board& board, const StripeSetup& setup, const Captures& captures,
                                std::span<const FoundTag> before, std::span<const FoundTag> after);

} // namespace frustumscreen
