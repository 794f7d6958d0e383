/// A picture of all words in all languages, as the kiosk sets them.
///
/// Threads  pure; any.
#pragma once

#include "app/image/image.h"
#include "app/pack/words_file.h"

#include <span>

namespace frustumscreen::programs {

[[nodiscard]] image::Image8 words_preview(std::span<const pack::LanguageWords> languages);

} // namespace frustumscreen::programs
