/// The safe page for a projector that shows one half of the picture to each eye, stretched over its whole picture: the
/// page twice, each time shrunk to a half, so that both eyes read the same words.
///
/// Shape    as draw_safe_rows.
/// Threads  pure; any.
#pragma once

#include "app/safe/safe_page.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace frustumscreen::safe {

enum class EyeHalves : std::uint8_t {
    None,   ///< both eyes see the whole picture
    Beside, ///< the left eye's half is the left one
    Below,  ///< the left eye's half is the upper one
};
/// For the settings' name of a stereo layout; None for every other text.
[[nodiscard]] EyeHalves halves_of(std::string_view stereo);

/// Draws the rows from `first_row` that fit `greys`, whose size is a multiple of the page's width.
void draw_rows_for_eyes(const SafePage& page, EyeHalves halves, int first_row, std::span<std::uint8_t> greys);

} // namespace frustumscreen::safe
