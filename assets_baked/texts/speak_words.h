/// Gives the exhibit's own words their sounds: the museum's recordings, otherwise a voice.
///
/// A recording is FOLDER/LANGUAGE/KEY.wav, .flac, .opus or .ogg. The voice speaks a language completely or
/// not at all.
///
/// Errors   one sentence: an unusable recording; a voice that fails.
/// Threads  one caller; the words of a language are spoken on all cores, and the result does not depend on
///          their number.
#pragma once

#include "app/pack/words_file.h"
#include "assets_baked/texts/voice.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::texts {

struct SpeakOptions {
    std::filesystem::path recordings; ///< empty: none
    std::optional<Voice> voice;       ///< nullopt: words without a recording are silent
    std::function<void(std::string_view what, double done)> progress; ///< may be empty
};

/// Returns the silent words with the reason, a sentence for each language.
[[nodiscard]] Result<std::vector<std::string>> speak_words(std::vector<pack::LanguageWords>& languages,
                                                           const SpeakOptions& options);

} // namespace frustumscreen::texts
