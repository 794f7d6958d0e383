/// A picture for looking at: WebP with loss.
///
/// Threads  pure; any.
#pragma once

#include "app/image/image.h"

namespace frustumscreen {

/// `quality` 0 to 100. Alpha is left out. Empty if WebP cannot hold it (nothing, or more than 16383 texels a side).
[[nodiscard]] Bytes encode_lossy_webp(const Image8& image, float quality);

} // namespace frustumscreen
