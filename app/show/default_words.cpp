#include "app/show/default_words.h"

#include "app/exhibit/languages.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>

namespace frustumscreen::show {

Result<pack::LanguageWords> read_default_words(const settings::Settings& settings, std::string_view key) {
    const std::string place = settings.exhibit.words.string();
    TRY(const Bytes file, read_file(settings.exhibit.words));
    TRY(const std::vector<pack::WordsLanguage> listed, at(place, pack::list_words(file)));
    std::vector<std::string> languages;
    for (const pack::WordsLanguage& language : listed) {
        languages.push_back(language.language);
    }
    TRY(pack::LanguageWords words,
        at(place,
           pack::read_words(file, languages[exhibit::caption_for(settings.exhibit.language, languages)])));
    if (words.runs.find(key) == nullptr) {
        return bad_input("show.word_missing",
                         "{}: has no word '{}'; bake it again with frustumscreen-bake --words", place, key);
    }
    return words;
}

} // namespace frustumscreen::show
