#include "app/show/default_words.h"

#include "app/exhibit/languages.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>

#include <memory>

namespace frustumscreen::show {

Result<pack::LanguageWords> read_default_words(const settings::Settings& settings, std::string_view key) {
    const std::string place = settings.exhibit.words.string();
    TRY(const Bytes file, read_file(settings.exhibit.words));
    TRY(const std::vector<pack::WordsLanguage> listed, at(place, pack::list_words(file)));
    const pack::WordsLanguage& nearest = listed[exhibit::item_for(settings.exhibit.language, listed)];
    TRY(pack::LanguageWords words, at(place, pack::read_words(file, nearest.language)));
    if (words.runs.find(key) == nullptr) {
        return bad_input("show.word_missing",
                         "{}: has no word '{}'; bake it again with frustumscreen-bake --words", place, key);
    }
    return words;
}

residency::SharedRecording word_recording(const pack::LanguageWords& words, const std::string& key,
                                          double gain_db) {
    const auto sound = words.sounds.find(key);
    if (sound == words.sounds.end()) {
        return nullptr;
    }
    return std::make_shared<const residency::PromptRecording>(
        residency::PromptRecording{.name = fmt::format("{} in '{}'", key, words.language),
                                   .opus = sound->second,
                                   .pack = {},
                                   .language = words.language,
                                   .key = key,
                                   .portions = {},
                                   .gain_db = gain_db});
}

} // namespace frustumscreen::show
