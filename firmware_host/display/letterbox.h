/// Where a picture goes on a screen of another size: as large as it fits, centred, nothing distorted.
#pragma once

#include <algorithm>
#include <cstdint>

namespace frustumscreen {

struct PixelSize {
    int width = 0;
    int height = 0;
    [[nodiscard]] bool operator==(const PixelSize&) const = default;
};

struct PixelPlace {
    int x = 0; ///< of the left column
    int y = 0; ///< of the first row
    int width = 0;
    int height = 0;
    [[nodiscard]] bool operator==(const PixelPlace&) const = default;
};

/// Both sizes at least 1 x 1.
[[nodiscard]] inline PixelPlace letterbox(PixelSize picture, PixelSize screen) {
    const auto scaled = [](int length, int numerator, int denominator) {
        const std::int64_t rounded = (2LL * length * numerator + denominator) / (2LL * denominator);
        return static_cast<int>(std::max<std::int64_t>(rounded, 1));
    };
    PixelPlace place{0, 0, screen.width, screen.height};
    if (std::int64_t{picture.width} * screen.height >= std::int64_t{screen.width} * picture.height) {
        place.height = std::min(scaled(picture.height, screen.width, picture.width), screen.height);
    } else {
        place.width = std::min(scaled(picture.width, screen.height, picture.height), screen.width);
    }
    place.x = (screen.width - place.width) / 2;
    place.y = (screen.height - place.height) / 2;
    return place;
}

} // namespace frustumscreen
