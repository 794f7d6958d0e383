/// The place of a picture on a screen of another size: as large as fits, centred, undistorted.
#pragma once

#include "firmware_host/base/pixel_rectangle.h"

#include <algorithm>
#include <cstdint>

namespace frustumscreen::display {

/// Both sizes are at least 1 x 1.
[[nodiscard]] inline PixelRectangle letterbox(PixelSize picture, PixelSize screen) {
    const auto scaled = [](int length, int numerator, int denominator) {
        const std::int64_t rounded = (2LL * length * numerator + denominator) / (2LL * denominator);
        return static_cast<int>(std::max<std::int64_t>(rounded, 1));
    };
    PixelRectangle place{.x = 0, .y = 0, .width = screen.width, .height = screen.height};
    if (std::int64_t{picture.width} * screen.height >= std::int64_t{screen.width} * picture.height) {
        place.height = std::min(scaled(picture.height, screen.width, picture.width), screen.height);
    } else {
        place.width = std::min(scaled(picture.width, screen.height, picture.height), screen.width);
    }
    place.x = (screen.width - place.width) / 2;
    place.y = (screen.height - place.height) / 2;
    return place;
}

/// The pixels of the screen that show `part` of the picture when the picture is at `place`. A screen pixel
/// between two pixels of the picture belongs to both.
[[nodiscard]] inline PixelRectangle part_on_screen(const PixelRectangle& part, PixelSize picture,
                                                   const PixelRectangle& place) {
    const auto from = [](int at, int screen, int whole) {
        return static_cast<int>((std::int64_t{at} * screen) / whole);
    };
    const auto to = [](int at, int screen, int whole) {
        return static_cast<int>((std::int64_t{at} * screen + whole - 1) / whole);
    };
    const int margin = picture.width == place.width && picture.height == place.height ? 0 : 1;
    const int left = from(std::max(part.x - margin, 0), place.width, picture.width);
    const int top = from(std::max(part.y - margin, 0), place.height, picture.height);
    const int right = to(std::min(part.x + part.width + margin, picture.width), place.width, picture.width);
    const int bottom =
        to(std::min(part.y + part.height + margin, picture.height), place.height, picture.height);
    return {.x = place.x + left,
            .y = place.y + top,
            .width = std::max(right - left, 0),
            .height = std::max(bottom - top, 0)};
}

} // namespace frustumscreen::display
