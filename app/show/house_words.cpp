#include "app/show/house_words.h"

#include "app/exhibit/languages.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>

namespace frustumscreen {

Result<LanguageWords> read_house_words(const Settings& settings, std::string_view key) {
    const std::string place = settings.exhibit.words.string();
    const Result<Bytes> file = read_file(settings.exhibit.words);
    if (!file) {
        return tl::unexpected<Error>(file.error());
    }
    const Result<std::vector<WordsLanguage>> listed = list_words(*file);
    if (!listed) {
        return at(place, listed.error());
    }
    std::vector<std::string> languages;
    for (const WordsLanguage& language : *listed) {
        languages.push_back(language.language);
    }
    Result<LanguageWords> words =
        read_words(*file, languages[caption_for(settings.exhibit.language, languages)]);
    if (!words) {
        return at(place, words.error());
    }
    if (words->runs.find(key) == nullptr) {
        return bad_input(
            fmt::format("{}: has no word '{}'; bake it again with frustumscreen-bake --words", place, key));
    }
    return words;
}

} // namespace frustumscreen
