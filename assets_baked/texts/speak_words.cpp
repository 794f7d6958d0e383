#include "assets_baked/texts/speak_words.h"

#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <map>

namespace frustumscreen {

namespace {

Result<std::optional<Speech>> recorded(const std::filesystem::path& folder, const LanguageWords& words,
                                       const std::string& key) {
    for (const char* ending : {".wav", ".flac", ".opus", ".ogg"}) {
        const std::filesystem::path file = folder / words.language / (key + ending);
        std::error_code ignored;
        if (folder.empty() || !std::filesystem::exists(file, ignored)) {
            continue;
        }
        const Result<Bytes> bytes = read_file(file, most_recording_bytes);
        if (!bytes) {
            return tl::unexpected<Error>(bytes.error());
        }
        const Result<Recording> recording = read_recording(*bytes, RecordingSource::File);
        Result<Speech> speech =
            recording ? level_speech(*recording) : tl::unexpected<Error>(recording.error());
        if (!speech) {
            return at(printable(file.string(), 300), speech.error());
        }
        return std::optional<Speech>(*std::move(speech));
    }
    return std::optional<Speech>();
}

/// Why the voice cannot speak a language, by language; asked once for all words.
class VoiceCheck {
public:
    VoiceCheck(const Voice& voice, const LanguageWords& words) {
        std::map<std::string, std::string> texts;
        for (const PlainWord& word : words.words) {
            texts[word.language] += word.text + "\n";
        }
        for (const auto& [language, text] : texts) {
            why_silent_[language] = voice.why_silent(text, language);
        }
    }
    [[nodiscard]] const std::optional<std::string>& why_silent(const std::string& language) const {
        return why_silent_.at(language);
    }

private:
    std::map<std::string, std::optional<std::string>> why_silent_;
};

/// Speaks one language; returns why some of its words are silent, or nothing.
Result<std::string> speak_language(LanguageWords& words, const SpeakOptions& options, double begin,
                                   double share) {
    std::optional<VoiceCheck> check;
    std::size_t silent = 0;
    std::string why = "there are no recordings and no voice";
    for (std::size_t k = 0; k < words.words.size(); ++k) {
        const PlainWord& word = words.words[k];
        if (options.progress) {
            options.progress(words.language, begin + share * static_cast<double>(k) /
                                                         static_cast<double>(words.words.size()));
        }
        Result<std::optional<Speech>> speech = recorded(options.recordings, words, word.key);
        if (!speech) {
            return tl::unexpected<Error>(speech.error());
        }
        if (!*speech && options.voice) {
            if (!check) {
                check.emplace(*options.voice, words);
            }
            if (const std::optional<std::string>& reason = check->why_silent(word.language)) {
                why = *reason;
            } else {
                Result<Speech> spoken = options.voice->speak(word.text, word.language);
                if (!spoken) {
                    return at(fmt::format("{}: {}", words.language, word.key), spoken.error());
                }
                *speech = *std::move(spoken);
            }
        }
        if (*speech) {
            words.sounds.insert_or_assign(word.key, std::move((*speech)->opus));
        } else {
            ++silent;
        }
    }
    return silent == 0 ? std::string()
                       : fmt::format("{} of {} words in '{}' are silent, and shown all the same: {}", silent,
                                     words.words.size(), words.language, why);
}

} // namespace

Result<std::vector<std::string>> speak_words(std::vector<LanguageWords>& languages,
                                             const SpeakOptions& options) {
    std::vector<std::string> silent;
    const double share = 1.0 / static_cast<double>(std::max<std::size_t>(languages.size(), 1));
    for (std::size_t k = 0; k < languages.size(); ++k) {
        Result<std::string> why =
            speak_language(languages[k], options, static_cast<double>(k) * share, share);
        if (!why) {
            return tl::unexpected<Error>(why.error());
        }
        if (!why->empty()) {
            silent.push_back(*std::move(why));
        }
    }
    return silent;
}

} // namespace frustumscreen
