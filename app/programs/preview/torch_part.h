/// The part of the preview's page about a torch: what it shows, and the artifact with its layers in a disc that follows the
/// pointer. Without scripts both pictures lie below each other.
///
/// Threads  pure; any.
#pragma once

#include "app/programs/preview/torch_pictures.h"

#include <string>
#include <vector>

namespace frustumscreen::programs {

/// Empty without contents.
[[nodiscard]] std::string torches_part(const std::vector<TorchPictures>& torches);
/// The rules that depend on the pictures' size and number.
[[nodiscard]] std::string style_of(const std::vector<TorchPictures>& torches);

} // namespace frustumscreen::programs
