#include "assets_baked/texts/speak_artifact.h"

#include "assets_baked/texts/recorded_speech.h"
#include "firmware_host/base/parallel.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

namespace frustumscreen {

namespace {

constexpr const char* key = "description";

/// What became of one description.
struct Spoken {
    std::optional<Speech> speech;
    std::string why_silent;
};

std::optional<std::filesystem::path> recording_of(const std::string& language, const SpeechSources& sources) {
    const auto named = sources.recordings.find(language);
    return named != sources.recordings.end() ? std::optional(named->second)
                                             : find_recording(sources.folder, language, key);
}

Result<Spoken> speak(const PackCaption& caption, const SpeechSources& sources) {
    if (const auto file = recording_of(caption.language, sources)) {
        Result<Speech> speech = read_speech(*file);
        return speech ? Result<Spoken>(Spoken{*std::move(speech), {}})
                      : tl::unexpected<Error>(speech.error());
    }
    if (!sources.voice) {
        return Spoken{std::nullopt, "there is no recording and no voice"};
    }
    if (std::optional<std::string> why = sources.voice->why_silent(caption.description, caption.language)) {
        return Spoken{std::nullopt, *std::move(why)};
    }
    Result<Speech> speech = sources.voice->speak(caption.description, caption.language);
    return speech ? Result<Spoken>(Spoken{*std::move(speech), {}})
                  : at(fmt::format("the description in '{}'", caption.language), speech.error());
}

} // namespace

Result<SpokenArtifact> speak_artifact(std::span<const PackCaption> captions, const SpeechSources& sources) {
    std::vector<Result<Spoken>> all(captions.size(), Spoken());
    parallel_for(captions.size(), 1, [&](std::size_t k, std::size_t) {
        if (!captions[k].description.empty()) {
            all[k] = speak(captions[k], sources);
        }
    });
    SpokenArtifact spoken;
    for (std::size_t k = 0; k < captions.size(); ++k) {
        const std::string& language = captions[k].language;
        if (!all[k]) {
            return tl::unexpected<Error>(all[k].error());
        }
        if (captions[k].description.empty()) {
            if (const auto file = recording_of(language, sources)) {
                spoken.notes.push_back(
                    fmt::format("{}: nobody can read what is spoken here, so it is left out; write it "
                                "as the description in '{}'",
                                printable(file->string(), 300), language));
            }
        } else if (all[k]->speech) {
            spoken.languages.push_back({language, {{key, std::move(all[k]->speech->opus)}}});
        } else {
            spoken.silent.push_back(
                fmt::format("the description in '{}' is silent, and shown all the same: {}", language,
                            all[k]->why_silent));
        }
    }
    return spoken;
}

} // namespace frustumscreen
