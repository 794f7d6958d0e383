/// The board as decoded from one rest's captures: the tags that are seen whole, lit and undisturbed, and the
/// projector's pixels at their corners.
///
/// Disturbed If nothing passes through the light, a bit and its inverse add up to white plus black, and a
///          cosine's steps make a wave without harmonics above the second, which a projector's gamma hardly
///          has.
/// Units    pixels of the projector and of the camera; metres in the prop's frame.
/// Threads  pure; any.
#pragma once

#include "app/calibration/board.h"
#include "app/calibration/gray_code.h"
#include "app/calibration/rest.h"
#include "firmware_host/tags/tag_detector.h"

#include <span>

namespace frustumscreen::calibration {

struct BoardView {
    std::vector<PropPoint> points; ///< four of each accepted tag
    int tags = 0;                  ///< accepted tags
    bool has_top = false;          ///< the tag of the prop's top is accepted
    int moved = 0;     ///< tags that moved between the white pictures before and after the stripes
    int disturbed = 0; ///< tags that something passed over meanwhile
    int clipped = 0;   ///< tags too bright for the camera
};

/// The board's tags among those found, except tags that were found twice.
[[nodiscard]] std::vector<tags::FoundTag> tags_of(const Board& board, std::span<const tags::FoundTag> found);

/// True if a corner moved by more than `farthest_px` in the camera's picture.
[[nodiscard]] bool has_moved(const tags::FoundTag& before, const tags::FoundTag& after, double farthest_px);

/// `before`, `after`: the board's tags in the white pictures before the stripes and after them.
[[nodiscard]] BoardView view_of(const Board& board, const StripeSetup& setup, const Captures& captures,
                                std::span<const tags::FoundTag> before,
                                std::span<const tags::FoundTag> after);

} // namespace frustumscreen::calibration
