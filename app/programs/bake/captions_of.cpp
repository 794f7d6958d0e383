#include "app/programs/bake/captions_of.h"

#include "app/settings/language_tag.h"
#include "firmware_host/base/printable.h"
#include "firmware_host/base/trimmed.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace frustumscreen::programs {

namespace {

pack::PackCaption* caption_in(std::vector<pack::PackCaption>& captions, std::string_view language) {
    const auto found = std::find_if(captions.begin(), captions.end(), [&](const pack::PackCaption& caption) {
        return caption.language == language;
    });
    return found != captions.end() ? &*found : nullptr;
}

Result<void> add_language(const std::string& written, const std::vector<pack::PackCaption>& from_file,
                          std::vector<pack::PackCaption>& captions) {
    const std::string found = fmt::format("--language '{}'", printable(written, 40));
    const std::string language = settings::parse_language_tag(written).value_or("");
    if (language.empty()) {
        return bad_input("captions.no_language", "{}: there is no such language; allowed are {}", found,
                         settings::allowed_language_tags);
    }
    if (caption_in(captions, language) != nullptr) {
        return bad_input("captions.language_twice", found + ": it is named twice; write each language once");
    }
    const auto in_file =
        std::find_if(from_file.begin(), from_file.end(),
                     [&](const pack::PackCaption& caption) { return caption.language == language; });
    captions.push_back(in_file != from_file.end()
                           ? *in_file
                           : pack::PackCaption{.language = language, .title = "", .text = ""});
    return {};
}

Result<void> add_text(const std::string& written, std::vector<std::string>& seen,
                      std::vector<pack::PackCaption>& captions) {
    const std::string found = fmt::format("--caption '{}'", printable(written, 40));
    const std::size_t equals = written.find('=');
    if (equals == std::string::npos) {
        return bad_input("captions.form", found + ": write LANGUAGE=TEXT, such as \"en=A cat.\"");
    }
    const std::string tag = written.substr(0, equals);
    const std::string language = settings::parse_language_tag(tag).value_or(tag);
    pack::PackCaption* const caption = caption_in(captions, language);
    if (caption == nullptr) {
        std::vector<std::string> languages;
        for (const pack::PackCaption& each : captions) {
            languages.push_back(each.language);
        }
        return bad_input("captions.other_language", "{}: the languages are {}; add --language {}", found,
                         fmt::join(languages, ", "), printable(language, 40));
    }
    if (std::find(seen.begin(), seen.end(), language) != seen.end()) {
        return bad_input("captions.twice",
                         "{}: there is a caption in {} already; write one for each language", found,
                         language);
    }
    seen.push_back(language);
    caption->text = std::string(trimmed(std::string_view(written).substr(equals + 1)));
    return {};
}

} // namespace

Result<std::vector<pack::PackCaption>> captions_of(const WrittenCaptions& written) {
    std::vector<pack::PackCaption> made;
    for (const std::string& language : written.languages) {
        TRY_VOID(add_language(language, written.from_file, made));
    }
    if (written.languages.empty()) {
        made = written.from_file.empty() ? std::vector<pack::PackCaption>{{"en", "", ""}} : written.from_file;
    }
    const std::string_view title = trimmed(written.title);
    for (pack::PackCaption& caption : made) {
        if (!title.empty()) {
            caption.title = std::string(title);
        } else if (caption.title.empty()) {
            caption.title = written.usual_title;
        }
    }
    std::vector<std::string> seen;
    for (const std::string& text : written.texts) {
        TRY_VOID(add_text(text, seen, made));
    }
    return made;
}

} // namespace frustumscreen::programs
