/// The captions of the bake's command line, which override those of the folder.
///
/// Errors   one sentence, wrong use: no language, a language or caption twice, a caption in a language that is not
///          named.
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"
#include "firmware_host/base/result.h"

#include <string>
#include <vector>

namespace frustumscreen::programs {

/// The captions as given on the command line and in the folder.
struct WrittenCaptions {
    std::string title;                        ///< empty: each caption's own title, or `usual_title`
    std::vector<std::string> languages;       ///< empty: those of `from_file`
    std::vector<std::string> texts;           ///< LANGUAGE=TEXT
    std::vector<pack::PackCaption> from_file; ///< captions of the folder's artifact.toml
    std::string usual_title;                  ///< title of a caption that has none otherwise
};

/// Returns one caption for each language, in the order given; English alone if none is given. A language without a text
/// has the title alone.
[[nodiscard]] Result<std::vector<pack::PackCaption>> captions_of(const WrittenCaptions& written);

} // namespace frustumscreen::programs
