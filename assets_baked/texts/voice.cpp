#include "assets_baked/texts/voice.h"

#include "assets_baked/texts/check_text.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace frustumscreen {

namespace {

bool begins_with_subtag(std::string_view language, std::string_view subtag) {
    return language.starts_with(subtag) &&
           (language.size() == subtag.size() || language[subtag.size()] == '-');
}

/// espeak-ng's name of the voice. Its plain voice for Chinese reads the letters' Latin spelling as if it were English.
std::string espeak_voice(const std::string& language) {
    return begins_with_subtag(language, "zh") ? "cmn-latn-pinyin" : language;
}

bool has_letter(std::string_view text, char32_t first, char32_t last) {
    while (!text.empty()) {
        const std::size_t bytes = std::max<std::size_t>(character_bytes(text), 1);
        const char32_t code = code_point_of(text);
        if (code >= first && code <= last) {
            return true;
        }
        text.remove_prefix(bytes);
    }
    return false;
}

/// Hebrew and Arabic letters are consonants; the vowels are marks, which texts leave out or have in part.
bool lacks_vowels(std::string_view text) {
    return has_letter(text, 0x05D0, 0x05EA) || has_letter(text, 0x0621, 0x064A);
}

} // namespace

Voice::Voice(std::string_view program, ProgramLimits limits) : limits_(limits) {
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
    if (lacks_vowels(text)) {
        return fmt::format("the language '{}' is written without its vowels, which espeak-ng cannot guess",
                           language);
    }
    const Result<Bytes> sounds =
        run_program({"espeak-ng", "-q", "-x", "--stdin", "-v", espeak_voice(language)}, text, limits_);
    if (!sounds) {
        return fmt::format("the language '{}' has no voice: {}", language, sounds.error().message);
    }
    // espeak-ng writes the language in brackets where it helps itself with another one.
    if (as_text(*sounds).find('(') != std::string_view::npos) {
        return fmt::format("espeak-ng cannot read all letters of the language '{}'", language);
    }
    return std::nullopt;
}

Result<Speech> Voice::speak(std::string_view text, const std::string& language) const {
    const std::vector<std::string> command = command_for(language);
    const Result<Bytes> wav = run_program(command, text, limits_);
    if (!wav) {
        return tl::unexpected<Error>(wav.error());
    }
    const Result<Recording> recording = read_recording(*wav, RecordingSource::Stream);
    if (!recording) {
        return at(fmt::format("{} on '{}'", printable(command.front()), printable(text, 40)),
                  recording.error());
    }
    Result<Speech> speech = level_speech(*recording);
    return speech ? std::move(speech)
                  : at(fmt::format("{} on '{}'", printable(command.front()), printable(text, 40)),
                       speech.error());
}

} // namespace frustumscreen
