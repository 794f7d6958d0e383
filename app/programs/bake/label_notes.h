/// Compares the languages of the hotspots' labels with those of the texts.
///
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"
#include "assets_baked/folder/artifact_file.h"

#include <span>
#include <string>
#include <vector>

namespace frustumscreen::programs {

/// Returns a sentence for each label that is missing in a language of `captions`, and for each label in a language
/// without texts. `left_out`: languages that were left out on purpose; their labels give no sentence.
[[nodiscard]] std::vector<std::string> label_notes(std::span<const folder::ArtifactHotspot> hotspots,
                                                   std::span<const pack::PackCaption> captions,
                                                   std::span<const std::string> left_out);

} // namespace frustumscreen::programs
