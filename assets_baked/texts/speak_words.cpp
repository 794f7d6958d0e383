#include "assets_baked/texts/speak_words.h"

#include "assets_baked/texts/recorded_speech.h"
#include "firmware_host/base/parallel.h"

#include <fmt/format.h>

#include <map>

namespace frustumscreen {

namespace {

/// Why the voice cannot speak a language, by language; asked once for all words.
class VoiceCheck {
public:
    VoiceCheck(const std::optional<Voice>& voice, const LanguageWords& words) {
        std::map<std::string, std::string> texts;
        for (const PlainWord& word : words.words) {
            texts[word.language] += word.text + "\n";
        }
        for (const auto& [language, text] : texts) {
            why_silent_[language] =
                voice ? voice->why_silent(text, language) : "there are no recordings and no voice";
        }
    }
    [[nodiscard]] const std::optional<std::string>& why_silent(const std::string& language) const {
        return why_silent_.at(language);
    }

private:
    std::map<std::string, std::optional<std::string>> why_silent_;
};

/// A recording, else what the voice says; nothing if neither can.
Result<std::optional<Speech>> speech_of(const PlainWord& word, const LanguageWords& words,
                                        const SpeakOptions& options, const VoiceCheck& check) {
    if (const auto file = find_recording(options.recordings, words.language, word.key)) {
        Result<Speech> recorded = read_speech(*file);
        return recorded ? Result<std::optional<Speech>>(*std::move(recorded))
                        : tl::unexpected<Error>(recorded.error());
    }
    if (!options.voice || check.why_silent(word.language)) {
        return std::optional<Speech>();
    }
    Result<Speech> spoken = options.voice->speak(word.text, word.language);
    if (!spoken) {
        return at(fmt::format("{}: {}", words.language, word.key), spoken.error());
    }
    return std::optional<Speech>(*std::move(spoken));
}

/// Speaks one language; returns why some of its words are silent, or nothing.
Result<std::string> speak_language(LanguageWords& words, const SpeakOptions& options) {
    const VoiceCheck check(options.voice, words);
    std::vector<Result<std::optional<Speech>>> speeches(words.words.size(), std::optional<Speech>());
    parallel_for(words.words.size(), 1, [&](std::size_t k, std::size_t) {
        speeches[k] = speech_of(words.words[k], words, options, check);
    });
    std::size_t silent = 0;
    std::string why;
    for (std::size_t k = 0; k < speeches.size(); ++k) {
        if (!speeches[k]) {
            return tl::unexpected<Error>(speeches[k].error());
        }
        if (*speeches[k]) {
            words.sounds.insert_or_assign(words.words[k].key, std::move((*speeches[k])->opus));
        } else {
            ++silent;
            why = check.why_silent(words.words[k].language).value_or("");
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
    for (std::size_t k = 0; k < languages.size(); ++k) {
        if (options.progress) {
            options.progress(languages[k].language,
                             static_cast<double>(k) / static_cast<double>(languages.size()));
        }
        Result<std::string> why = speak_language(languages[k], options);
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
