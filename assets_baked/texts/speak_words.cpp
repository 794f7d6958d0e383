#include "assets_baked/texts/speak_words.h"

#include "assets_baked/texts/recorded_speech.h"
#include "firmware_host/base/parallel.h"

#include <fmt/format.h>

#include <atomic>
#include <map>

namespace frustumscreen::texts {

namespace {

/// The reasons why the voice cannot speak a language, by language; determined once for all words.
class VoiceCheck {
public:
    VoiceCheck(const std::optional<Voice>& voice, const pack::LanguageWords& words) {
        std::map<std::string, std::string> texts;
        for (const pack::PlainWord& word : words.words) {
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

/// Uses the recording, otherwise the voice.
Result<Spoken> speak(const pack::PlainWord& word, const pack::LanguageWords& words,
                     const SpeakOptions& options, const VoiceCheck& check) {
    if (const auto file = find_recording(options.recordings, words.language, word.key)) {
        TRY(Speech recorded, read_speech(*file));
        return Spoken{std::move(recorded), {}};
    }
    if (const std::optional<std::string>& why = check.why_silent(word.language)) {
        return Spoken{std::nullopt, *why};
    }
    return at(fmt::format("{}: {}", words.language, word.key),
              options.voice->speak(word.text, word.language));
}

/// Speaks one language; returns a sentence if some of its words are silent, otherwise an empty string.
Result<std::string> speak_language(pack::LanguageWords& words, const SpeakOptions& options) {
    const VoiceCheck check(options.voice, words);
    std::vector<Result<Spoken>> all(words.words.size(), Spoken());
    std::atomic<bool> failed{false}; // one message about a voice is enough, and each attempt may take half a
                                     // minute
    parallel_for(words.words.size(), 1, [&](std::size_t k, std::size_t) {
        if (!failed) {
            all[k] = speak(words.words[k], words, options, check);
            failed = failed || !all[k];
        }
    });
    std::size_t silent = 0;
    std::string why;
    for (std::size_t k = 0; k < all.size(); ++k) {
        if (!all[k]) {
            return tl::unexpected<Error>(all[k].error());
        }
        if (all[k]->speech) {
            words.sounds.insert_or_assign(words.words[k].key, std::move(all[k]->speech->opus));
        } else {
            ++silent;
            why = all[k]->why_silent;
        }
    }
    return silent == 0 ? std::string()
                       : fmt::format("{} of {} words in '{}' are silent, but they are shown: {}", silent,
                                     words.words.size(), words.language, why);
}

} // namespace

Result<std::vector<std::string>> speak_words(std::vector<pack::LanguageWords>& languages,
                                             const SpeakOptions& options) {
    std::vector<std::string> silent;
    for (std::size_t k = 0; k < languages.size(); ++k) {
        if (options.progress) {
            options.progress(languages[k].language,
                             static_cast<double>(k) / static_cast<double>(languages.size()));
        }
        TRY(std::string why, speak_language(languages[k], options));
        if (!why.empty()) {
            silent.push_back(std::move(why));
        }
    }
    return silent;
}

} // namespace frustumscreen::texts
