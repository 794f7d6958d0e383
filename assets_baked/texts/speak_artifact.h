/// Speaks the audio descriptions of an artifact: the curator's recordings, else a voice.
///
/// A recording is the one that is named for its language, else FOLDER/LANGUAGE/description.wav, .flac, .opus or .ogg. Its words
/// must be there as the description: who does not hear reads them.
///
/// Errors   one sentence: a recording that is bad; a voice that fails on the way.
/// Threads  one caller; the languages are spoken on all cores, with the same result.
#pragma once

#include "app/pack/pack.h"
#include "app/pack/pack_texts.h"
#include "assets_baked/texts/voice.h"

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen {

struct SpeechSources {
    std::map<std::string, std::filesystem::path> recordings; ///< by language, as named
    std::filesystem::path folder;                            ///< empty: none
    std::vector<std::string>
        left_out;               ///< languages that are not baked on purpose: their recordings may lie there
    std::optional<Voice> voice; ///< nothing: descriptions without a recording are silent
};

struct SpokenArtifact {
    std::vector<SpokenLanguage> languages;
    std::vector<std::string> silent; ///< which descriptions, and why, a sentence for each reason
    std::vector<std::string> notes; ///< which recordings nobody hears, or fit no description, a sentence each
};

[[nodiscard]] Result<SpokenArtifact> speak_artifact(std::span<const PackCaption> captions,
                                                    const SpeechSources& sources);

} // namespace frustumscreen
