/// Speaks the audio descriptions of an artifact: the curator's recordings, otherwise a voice.
///
/// The recording of a language is the one named for it, otherwise FOLDER/LANGUAGE/description.wav, .flac,
/// .opus or .ogg. The spoken words must also exist as the written description, for visitors who cannot hear.
///
/// Errors   one sentence: an unusable recording; a voice that fails.
/// Threads  one caller; the languages are spoken on all cores, and the result does not depend on their
///          number.
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

namespace frustumscreen::texts {

struct SpeechSources {
    std::map<std::string, std::filesystem::path> recordings; ///< by language, if named explicitly
    std::filesystem::path folder;                            ///< empty: none
    std::vector<std::string>
        left_out;               ///< languages that are not baked on purpose, whose recordings may be present
    std::optional<Voice> voice; ///< nullopt: descriptions without a recording are silent
};

struct SpokenArtifact {
    std::vector<pack::SpokenLanguage> languages;
    std::vector<std::string> silent; ///< descriptions and reasons, a sentence for each reason
    std::vector<std::string> notes;  ///< recordings that are unused or fit no description, a sentence each
};

[[nodiscard]] Result<SpokenArtifact> speak_artifact(std::span<const pack::PackCaption> captions,
                                                    const SpeechSources& sources);

} // namespace frustumscreen::texts
