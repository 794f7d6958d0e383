/// Shared parts of the picture decoders.
///
/// Threads  pure; any.
#pragma once

#include "app/image/image.h"
#include "assets_baked/bake/loaders/bytes.h"
#include "firmware_host/base/result.h"

#include <fmt/format.h>

#include <cstdint>

namespace frustumscreen::bake {

[[nodiscard]] inline const std::uint8_t* raw(ByteView bytes) {
    return reinterpret_cast<const std::uint8_t*>(bytes.data());
}
[[nodiscard]] inline std::uint8_t* raw(image::Image8& image) {
    return reinterpret_cast<std::uint8_t*>(image.texels.data());
}

[[nodiscard]] inline std::int64_t texels_of(const image::Image8& image) {
    return static_cast<std::int64_t>(image.texels.size());
}

[[nodiscard]] inline tl::unexpected<Error> too_large(std::int64_t width, std::int64_t height,
                                                     std::int64_t limit_texels) {
    return bad_input(
        "picture.too_large",
        "the picture has {} x {} texels, at most {} are allowed; make it smaller, or cut it into "
        "several",
        width, height, limit_texels);
}

/// Errors   a side below 1, or more texels than allowed.
[[nodiscard]] inline Result<image::Image8> blank_image(std::int64_t width, std::int64_t height,
                                                       std::int64_t limit_texels) {
    if (width < 1 || height < 1) {
        return bad_input("picture.no_texels", "the picture is damaged: by its header it has {} x {} texels",
                         width, height);
    }
    if (width > limit_texels / height) {
        return too_large(width, height, limit_texels);
    }
    return image::Image8(static_cast<int>(width), static_cast<int>(height));
}

} // namespace frustumscreen::bake
