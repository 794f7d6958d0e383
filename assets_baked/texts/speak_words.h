/// Gives the exhibit's own words their sounds: the museum's recordings, else a voice.
///
/// A recording is FOLDER/LANGUAGE/KEY.wav, .flac, .opus or .ogg. A language is spoken by the voice whole or not at all.
///
/// Errors   one sentence: a recording that is bad; a voice that fails on the way.
/// Threads  one caller; the words of a language are spoken on all cores, with the same result.
#pragma once

#include "app/pack/words_file.h"
#include "assets_baked/texts/voice.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

struct SpeakOptions {
    std::filesystem::path recordings; ///< empty: none
    std::optional<Voice> voice;       ///< nothing: words without a recording are silent
    std::function<void(std::string_view what, double done)> progress; ///< may be empty
};

/// Returns which words are silent and why, a sentence for each language.
[[nodiscard]] Result<std::vector<std::string>> speak_words(std::vector<LanguageWords>& languages,
                                                           const SpeakOptions& options);

} // namespace frustumscreen
