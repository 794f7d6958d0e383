/// The captions that a person wrote on the bake's command line, over those of the folder.
///
/// Errors   one sentence, wrong use: no language, a language or caption twice, a caption in a language not named.
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"
#include "firmware_host/base/result.h"

#include <string>
#include <vector>

namespace frustumscreen {

/// What was written about the captions.
struct WrittenCaptions {
    std::string title;                  ///< empty: each caption's own, or `usual_title`
    std::vector<std::string> languages; ///< empty: those of `from_file`
    std::vector<std::string> texts;     ///< LANGUAGE=TEXT
    std::vector<PackCaption> from_file; ///< of the folder's artifact.toml
    std::string usual_title;            ///< of a caption that has none otherwise
};

/// One for each language, in the order written; English alone if none is written anywhere. A language without a text
/// has the title alone.
[[nodiscard]] Result<std::vector<PackCaption>> captions_of(const WrittenCaptions& written);

} // namespace frustumscreen
