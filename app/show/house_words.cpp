#include "app/show/house_words.h"

#include "app/exhibit/languages.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>

namespace frustumscreen {

Result<LanguageWords> read_house_words(const Settings& settings, std::string_view key) {
    const std::string place = settings.exhibit.words.string();
    TRY(const Bytes file, read_file(settings.exhibit.words));
    TRY(const std::vector<WordsLanguage> listed, at(place, list_words(file)));
    std::vector<std::string> languages;
    for (const WordsLanguage& language : listed) {
        languages.push_back(language.language);
    }
    TRY(LanguageWords words,
        at(place, read_words(file, languages[caption_for(settings.exhibit.language, languages)])));
    if (words.runs.find(key) == nullptr) {
        return bad_input("show.word_missing",
                         "{}: has no word '{}'; bake it again with frustumscreen-bake --words", place, key);
    }
    return words;
}

} // namespace frustumscreen
