#include "assets_baked/bake/loaders/source_about.h"

#include "firmware_host/base/trimmed.h"

#include <algorithm>
#include <array>
#include <regex>
#include <string>

namespace frustumscreen::bake {

namespace {

constexpr std::size_t max_bytes = 1000; ///< limit of a pack's line

/// Joins the text to one line and removes control characters, which a terminal or page would interpret.
std::string one_line(std::string_view text) {
    std::size_t end = std::min(text.size(), max_bytes);
    while (end > 0 && end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) {
        --end; // keeps the last character whole
    }
    std::string line;
    for (const char c : text.substr(0, end)) {
        const auto code = static_cast<unsigned char>(c);
        const bool is_blank = code <= 0x20 || code == 0x7f;
        if (!is_blank || (!line.empty() && line.back() != ' ')) {
            line += is_blank ? ' ' : c;
        }
    }
    return std::string(trimmed(line));
}

void take(std::string& value, std::string_view text) {
    if (value.empty()) {
        value = one_line(text);
    }
}

/// The Creative Commons licence in a copyright notice, as written there; empty: none.
std::string licence_in(const std::string& notice) {
    static const std::regex known(R"(\bCC0(?:[- ]1\.0)?|\bCC[- ]BY(?:[- ](?:NC|SA|ND))*(?:[- ]\d\.\d)?)",
                                  std::regex::icase);
    std::smatch found;
    return std::regex_search(notice, found, known) ? found.str() : std::string();
}

/// Takes the author, and often the licence, from a copyright notice.
void take_notice(std::string_view notice, SourceAbout& about) {
    const std::string line = one_line(notice);
    take(about.author, line);
    take(about.licence, licence_in(line));
}

std::string_view text_in(const nlohmann::json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string()
               ? std::string_view(found->get_ref<const std::string&>())
               : std::string_view();
}

std::string lower(std::string_view text) {
    std::string made(text);
    std::transform(made.begin(), made.end(), made.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c; });
    return made;
}

} // namespace

SourceAbout about_of_gltf(const nlohmann::json& document) {
    SourceAbout about;
    const auto asset = document.is_object() ? document.find("asset") : document.end();
    if (asset == document.end() || !asset->is_object()) {
        return about;
    }
    if (const auto extras = asset->find("extras"); extras != asset->end() && extras->is_object()) {
        take(about.title, text_in(*extras, "title"));
        take(about.author, text_in(*extras, "author"));
        take(about.licence, text_in(*extras, "license"));
        take(about.source, text_in(*extras, "source"));
    }
    take_notice(text_in(*asset, "copyright"), about);
    return about;
}

void take_comment(std::string_view comment, SourceAbout& about) {
    const std::string_view line = trimmed(comment);
    const std::string small = lower(line.substr(0, 40));
    const std::size_t colon = line.find(':');
    const std::string key = lower(trimmed(line.substr(0, std::min(colon, line.size()))));
    const bool is_pair = colon != std::string_view::npos;
    const std::string_view value = is_pair ? line.substr(colon + 1) : std::string_view();
    if (is_pair && key == "title") {
        take(about.title, value);
    } else if (is_pair && (key == "author" || key == "creator")) {
        take(about.author, value);
    } else if (is_pair && (key == "license" || key == "licence")) {
        take(about.licence, value);
    } else if (is_pair && (key == "source" || key == "url")) {
        take(about.source, value);
    } else if (is_pair && key == "copyright") {
        take_notice(value, about);
    } else if (small.starts_with("copyright ") || small.starts_with("(c) ") || line.starts_with("\u00A9")) {
        take_notice(line, about);
    }
}

void take_comments(std::string_view text, SourceAbout& about) {
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
        const std::string_view line = trimmed(text.substr(0, end));
        if (line.starts_with('#')) {
            take_comment(line.substr(std::min(line.find_first_not_of('#'), line.size())), about);
        }
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

} // namespace frustumscreen::bake
