#include "assets_baked/texts/voice.h"

#include "assets_baked/texts/check_text.h"
#include "assets_baked/texts/fonts.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <pango/pango.h>

#include <algorithm>
#include <sstream>
#include <utility>

namespace frustumscreen::texts {

namespace {

bool begins_with_subtag(std::string_view language, std::string_view subtag) {
    return language.starts_with(subtag) &&
           (language.size() == subtag.size() || language[subtag.size()] == '-');
}

/// espeak-ng's name of the voice. Its default voice for Chinese reads the romanised letters as if they were
/// English.
std::string espeak_voice(const std::string& language) {
    return begins_with_subtag(language, "zh") ? "cmn-latn-pinyin" : language;
}

/// True for scripts without vowels. Among the scripts of espeak-ng's voices these are the ones from right to left:
/// vowels are marks there, which texts omit entirely or in part.
bool lacks_vowels(std::string_view language) {
    return direction_of(language) == pack::TextDirection::RightToLeft;
}

/// True if the voice of `language` has a sound for the letter. Voices of other scripts read Latin words as
/// English.
bool is_read(char32_t letter, const std::string& language) {
    const auto script = static_cast<PangoScript>(g_unichar_get_script(letter));
    if (script == PANGO_SCRIPT_HAN) {
        return begins_with_subtag(language, "zh") || begins_with_subtag(language, "yue");
    }
    return script == PANGO_SCRIPT_LATIN ||
           pango_language_includes_script(pango_language_from_string(language.c_str()), script) != 0;
}

/// The first sequence of letters in `text` that the voice cannot read; empty if it can read all. A single
/// Greek letter is a symbol, which has a name in every language.
std::string unread_word(std::string_view text, const std::string& language) {
    const auto is_sign = [](std::string_view word) {
        const char32_t letter = code_point_of(word);
        return word.size() == character_bytes(word) && letter >= 0x0391 && letter <= 0x03C9;
    };
    std::string word;
    for (; !text.empty(); text.remove_prefix(std::max<std::size_t>(character_bytes(text), 1))) {
        const char32_t letter = code_point_of(text);
        const bool belongs = g_unichar_isalpha(letter) || (g_unichar_ismark(letter) && !word.empty());
        if (belongs && !is_read(letter, language)) {
            word += text.substr(0, character_bytes(text));
        } else if (!word.empty() && (!belongs || !g_unichar_ismark(letter))) {
            if (!is_sign(word)) {
                return word;
            }
            word.clear();
        }
    }
    return is_sign(word) ? std::string() : word;
}

/// True if more than half of the sounds are those of other voices. espeak-ng writes a voice's name in
/// brackets where it switches to it, and ends with its own.
bool is_mostly_foreign(std::string_view sounds) {
    const std::size_t last = sounds.rfind('(');
    if (last == std::string_view::npos) {
        return false;
    }
    const std::string_view own = sounds.substr(last, sounds.find(')', last) - last);
    std::size_t foreign = 0;
    std::size_t all = 0;
    bool is_foreign = false;
    for (std::size_t at = 0; at < sounds.size(); ++at) {
        if (sounds[at] == '(') {
            is_foreign = !sounds.substr(at).starts_with(own);
            at = std::min(sounds.find(')', at), sounds.size());
        } else if (sounds[at] != ' ' && sounds[at] != '\n') {
            ++all;
            foreign += is_foreign ? 1 : 0;
        }
    }
    return 2 * foreign > all;
}

} // namespace

Voice::Voice(std::string_view program, ProgramLimits limits) : limits_(std::move(limits)) {
    std::istringstream words{std::string(program)};
    for (std::string word; words >> word;) {
        program_.push_back(word);
    }
}

std::vector<std::string> Voice::command_for(const std::string& language) const {
    if (program_.empty()) {
        return {"espeak-ng", "--stdin", "--stdout", "-v", espeak_voice(language)};
    }
    std::vector<std::string> command = program_;
    constexpr std::string_view mark = "{language}";
    for (std::string& word : command) {
        for (std::size_t at = word.find(mark); at != std::string::npos;
             at = word.find(mark, at + language.size())) {
            word.replace(at, mark.size(), language);
        }
    }
    return command;
}

std::optional<std::string> Voice::why_silent(std::string_view text, const std::string& language) const {
    if (!program_.empty()) {
        return std::nullopt;
    }
    if (lacks_vowels(language)) {
        return fmt::format("the language '{}' is written without its vowels, which espeak-ng cannot guess",
                           language);
    }
    if (const std::string word = unread_word(text, language); !word.empty()) {
        return fmt::format("espeak-ng cannot read '{}' in the language '{}'; write it in that language's "
                           "letters, or give a recording or another voice",
                           printable(word, 60), language);
    }
    const Result<Bytes> sounds =
        run_program({"espeak-ng", "-q", "-x", "--stdin", "-v", espeak_voice(language)}, text, limits_);
    if (!sounds) {
        return fmt::format("the language '{}' has no voice: {}", language, sounds.error().message);
    }
    if (is_mostly_foreign(as_text(*sounds))) {
        return fmt::format("espeak-ng reads most of the text as another language than '{}'; give a recording "
                           "or another voice",
                           language);
    }
    return std::nullopt;
}

Result<Spoken> Voice::speak(std::string_view text, const std::string& language) const {
    const std::vector<std::string> command = command_for(language);
    TRY(const Bytes wav, run_program(command, text, limits_));
    const std::string place = fmt::format("{} on '{}'", printable(command.front()), printable(text, 40));
    TRY(const Recording recording, at(place, read_recording(wav, RecordingSource::Stream)));
    TRY(std::optional<Speech> speech, at(place, level_speech(recording)));
    return speech ? Spoken{std::move(speech), {}}
                  : Spoken{std::nullopt, fmt::format("{} finds nothing to speak in '{}'",
                                                     printable(command.front()), printable(text, 40))};
}

} // namespace frustumscreen::texts
