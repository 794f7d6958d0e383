#include "app/programs/bake/captions_of.h"

#include "app/settings/language_tag.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace frustumscreen {

namespace {

PackCaption* caption_in(std::vector<PackCaption>& captions, std::string_view language) {
    const auto found = std::find_if(captions.begin(), captions.end(),
                                    [&](const PackCaption& caption) { return caption.language == language; });
    return found != captions.end() ? &*found : nullptr;
}

Result<void> add_language(const std::string& language, const std::string& title,
                          std::vector<PackCaption>& captions) {
    const std::string found = fmt::format("--language '{}'", printable(language, 40));
    if (!parse_language_tag(language)) {
        return bad_input(
            fmt::format("{}: there is no such language; allowed are {}", found, allowed_language_tags));
    }
    if (caption_in(captions, language) != nullptr) {
        return bad_input(found + ": it is named already; write each language once");
    }
    captions.push_back({language, title, ""});
    return {};
}

Result<void> add_text(const std::string& written, std::span<const std::string> languages,
                      std::vector<std::string>& seen, std::vector<PackCaption>& captions) {
    const std::string found = fmt::format("--caption '{}'", printable(written, 40));
    const std::size_t equals = written.find('=');
    if (equals == std::string::npos) {
        return bad_input(found + ": write LANGUAGE=TEXT, such as \"en=A cat.\"");
    }
    const std::string language = written.substr(0, equals);
    PackCaption* const caption = caption_in(captions, language);
    if (caption == nullptr) {
        return bad_input(fmt::format("{}: the languages are {}; add --language {}", found,
                                     languages.empty() ? "en" : fmt::format("{}", fmt::join(languages, ", ")),
                                     printable(language, 40)));
    }
    if (std::find(seen.begin(), seen.end(), language) != seen.end()) {
        return bad_input(fmt::format("{}: there is a caption in {} already; write one for each language",
                                     found, language));
    }
    seen.push_back(language);
    caption->text = written.substr(equals + 1);
    return {};
}

} // namespace

Result<std::vector<PackCaption>> captions_of(const std::string& title, std::span<const std::string> languages,
                                             std::span<const std::string> captions) {
    std::vector<PackCaption> made;
    for (const std::string& language : languages) {
        if (const Result<void> added = add_language(language, title, made); !added) {
            return tl::unexpected<Error>(added.error());
        }
    }
    if (languages.empty()) {
        made.push_back({"en", title, ""});
    }
    std::vector<std::string> seen;
    for (const std::string& caption : captions) {
        if (const Result<void> added = add_text(caption, languages, seen, made); !added) {
            return tl::unexpected<Error>(added.error());
        }
    }
    return made;
}

} // namespace frustumscreen
