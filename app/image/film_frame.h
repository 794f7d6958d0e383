/// WebP pictures of any kind but animations: the frames of a film and pictures with a lossy texture. image.h reads only
/// lossless ones.
///
/// Errors   not a still WebP picture; damaged; another size than the caller expects. Memory is allocated after these
///          checks.
/// Threads  pure; any.
#pragma once

#include "app/image/image.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <span>

namespace frustumscreen::image {

[[nodiscard]] Result<PictureExtent> extent_of_still(std::span<const std::byte> beginning);
/// A still of another size is an error.
[[nodiscard]] Result<Image8> decode_still(std::span<const std::byte> bytes, const PictureExtent& expected);
/// Lossy colours, exact alpha; `quality` 0 to 100. Empty if WebP cannot hold it.
[[nodiscard]] Bytes encode_film_frame(const Image8& image, float quality);

} // namespace frustumscreen::image
