/// Chooses the language nearest to the requested one. Languages are named by BCP 47 tags.
///
/// Threads  pure; any.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::exhibit {

/// Index of the caption for `language` among captions in `languages`: the same tag, else the same language
/// with another region or script, else English, else the first. `languages` is not empty.
[[nodiscard]] std::size_t caption_for(std::string_view language, std::span<const std::string> languages);
/// The same for items that have a member `language`.
template <typename Items> [[nodiscard]] std::size_t item_for(std::string_view language, const Items& items) {
    std::vector<std::string> languages;
    for (const auto& item : items) {
        languages.push_back(item.language);
    }
    return caption_for(language, languages);
}
/// Appends the language if it is not in the list.
void add_language(std::vector<std::string>& languages, const std::string& language);
/// True if one of them is this language, with any region and script.
[[nodiscard]] bool has_language(std::span<const std::string> languages, std::string_view language);

} // namespace frustumscreen::exhibit
