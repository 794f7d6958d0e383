#include "app/exhibit/languages.h"

#include <algorithm>

namespace frustumscreen::exhibit {

namespace {

std::string_view primary(std::string_view tag) {
    return tag.substr(0, tag.find('-'));
}

} // namespace

std::size_t caption_for(std::string_view language, std::span<const std::string> languages) {
    const auto find = [&](auto&& fits) {
        return static_cast<std::size_t>(std::find_if(languages.begin(), languages.end(), fits) -
                                        languages.begin());
    };
    std::size_t best = find([&](const std::string& tag) { return tag == language; });
    if (best == languages.size()) {
        best = find([&](const std::string& tag) { return primary(tag) == primary(language); });
    }
    if (best == languages.size()) {
        best = find([&](const std::string& tag) { return primary(tag) == "en"; });
    }
    return best == languages.size() ? 0 : best;
}

void add_language(std::vector<std::string>& languages, const std::string& language) {
    if (std::find(languages.begin(), languages.end(), language) == languages.end()) {
        languages.push_back(language);
    }
}

bool has_language(std::span<const std::string> languages, std::string_view language) {
    return std::any_of(languages.begin(), languages.end(),
                       [&](const std::string& tag) { return primary(tag) == primary(language); });
}

} // namespace frustumscreen::exhibit
