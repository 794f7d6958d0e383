/// A picture that is halved while it is read, and how often.
///
/// Threads  pure; any.
#pragma once

#include "app/image/image.h"
#include "app/image/row_shrinker.h"
#include "assets_baked/bake/loaders/picture_bytes.h"

#include <algorithm>
#include <cstdint>
#include <functional>

namespace frustumscreen::bake {

/// A picture that may have been halved, several times.
struct ShrunkImage {
    image::Image8 image;
    glm::ivec2 file_size{0}; ///< texels, as in the file
};

/// Says how often a picture of this size is halved.
using Halvings = std::function<int(const glm::ivec2& file_size)>;

/// How often a picture is halved until it has at most `kept_texels`, or one.
[[nodiscard]] inline int halvings_within(const glm::ivec2& size, std::int64_t kept_texels) {
    const auto texels = [](const glm::ivec2& each) { return std::int64_t{each.x} * each.y; };
    int halvings = 0;
    while (texels(image::halved_size(size, halvings)) > std::max<std::int64_t>(kept_texels, 1)) {
        ++halvings;
    }
    return halvings;
}

/// `image` after that many halvings.
[[nodiscard]] inline image::Image8 halved(image::Image8 image, int halvings) {
    for (int k = 0; k < halvings; ++k) {
        image = image::half_size(image);
    }
    return image;
}

/// The largest picture that is read by its rows; this bounds the time.
inline constexpr std::int64_t max_coded_texels = std::int64_t{1} << 30;

/// Takes the rows of a picture that is `width` x `height` in its file.
/// Errors   a side below 1; more than `max_coded_texels`, or after the halvings more than `limit_texels`.
[[nodiscard]] inline Result<image::RowShrinker>
row_shrinker(std::int64_t width, std::int64_t height, const Halvings& halvings, std::int64_t limit_texels) {
    if (width < 1 || height < 1 || width > max_coded_texels / height) {
        return too_large(width, height, std::min(limit_texels, max_coded_texels));
    }
    const glm::ivec2 size(static_cast<int>(width), static_cast<int>(height));
    const int times = halvings(size);
    const glm::ivec2 shrunk = image::halved_size(size, times);
    if (std::int64_t{shrunk.x} * shrunk.y > limit_texels) {
        return too_large(width, height, limit_texels);
    }
    return image::RowShrinker(size, times);
}

} // namespace frustumscreen::bake
