#include "assets_baked/texts/speak_artifact.h"

#include "app/pack/text_portions.h"
#include "assets_baked/texts/recorded_speech.h"
#include "firmware_host/base/parallel.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <utility>

namespace frustumscreen::texts {

namespace {

constexpr const char* key = "description";

std::optional<std::filesystem::path> recording_of(const std::string& language, const SpeechSources& sources) {
    const auto named = sources.recordings.find(language);
    return named != sources.recordings.end() ? std::optional(named->second)
                                             : find_recording(sources.folder, language, key);
}

Result<Spoken> speak(const pack::PackCaption& caption, const SpeechSources& sources) {
    if (const auto file = recording_of(caption.language, sources)) {
        TRY(Speech speech, read_speech(*file));
        return Spoken{std::move(speech), {}};
    }
    if (!sources.voice) {
        return Spoken{std::nullopt, "there is no recording and no voice"};
    }
    if (std::optional<std::string> why = sources.voice->why_silent(caption.description, caption.language)) {
        return Spoken{std::nullopt, *std::move(why)};
    }
    return at(fmt::format("the description in '{}'", caption.language),
              sources.voice->speak(caption.description, caption.language));
}

/// A sentence if the lengths of recording and description differ so much that they must belong to different
/// texts.
std::optional<std::string> length_note(const pack::PackCaption& caption, const std::filesystem::path& file,
                                       double seconds) {
    constexpr double min_share = 0.4;
    constexpr double max_share = 3.0;
    const double words_s = pack::reading_time_s(caption.description);
    const double brief_s = 3.0; // tolerance for pauses
    if (seconds >= min_share * words_s && seconds <= max_share * words_s + brief_s) {
        return std::nullopt;
    }
    return fmt::format(
        "{}: it lasts {:.0f} s, and to speak the description in '{}' takes about {:.0f} s; see "
        "whether both are of the same text",
        printable(file.string(), 300), seconds, caption.language, words_s);
}

/// One sentence for each reason, with its languages.
class Silences {
public:
    void add(const std::string& why, const std::string& language) {
        const auto found =
            std::find_if(all_.begin(), all_.end(), [&](const auto& each) { return each.first == why; });
        std::vector<std::string>& languages =
            found != all_.end() ? found->second : all_.emplace_back(why, std::vector<std::string>()).second;
        languages.push_back(fmt::format("'{}'", language));
    }
    [[nodiscard]] std::vector<std::string> sentences() const {
        std::vector<std::string> made;
        for (const auto& [why, languages] : all_) {
            made.push_back(fmt::format("the description in {} is silent, but it is shown: {}",
                                       fmt::join(languages, ", "), why));
        }
        return made;
    }

private:
    std::vector<std::pair<std::string, std::vector<std::string>>> all_;
};

} // namespace

Result<SpokenArtifact> speak_artifact(std::span<const pack::PackCaption> captions,
                                      const SpeechSources& sources) {
    std::vector<Result<Spoken>> all(captions.size(), Spoken());
    std::atomic<bool> failed{false}; // one message about a voice is enough, and each attempt may take half a
                                     // minute
    parallel_for(captions.size(), 1, [&](std::size_t k, std::size_t) {
        if (!captions[k].description.empty() && !failed) {
            all[k] = speak(captions[k], sources);
            failed = failed || !all[k];
        }
    });
    SpokenArtifact spoken;
    Silences silences;
    RecordingNames names;
    for (std::size_t k = 0; k < captions.size(); ++k) {
        const std::string& language = captions[k].language;
        if (!all[k]) {
            return tl::unexpected<Error>(all[k].error());
        }
        names[fmt::format("{}/{}", language, key)] = recording_of(language, sources);
        if (captions[k].description.empty()) {
            if (const auto file = recording_of(language, sources)) {
                spoken.notes.push_back(fmt::format("{}: there is no text of this recording, so it is left "
                                                   "out; write its words as the description in '{}'",
                                                   printable(file->string(), 300), language));
            }
        } else if (all[k]->speech) {
            const auto file = recording_of(language, sources);
            if (const auto note =
                    file ? length_note(captions[k], *file, all[k]->speech->seconds) : std::nullopt) {
                spoken.notes.push_back(*note);
            }
            spoken.languages.push_back({language, {{key, std::move(all[k]->speech->opus)}}});
        } else {
            silences.add(all[k]->why_silent, language);
        }
    }
    spoken.silent = silences.sentences();
    const std::vector<std::string> unused = unused_recordings(sources.folder, names, sources.left_out);
    spoken.notes.insert(spoken.notes.end(), unused.begin(), unused.end());
    return spoken;
}

} // namespace frustumscreen::texts
