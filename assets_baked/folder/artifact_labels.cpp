#include "assets_baked/folder/artifact_labels.h"

#include "app/pack/container/limits.h"
#include "app/pack/pack_text.h"
#include "app/settings/language_tag.h"
#include "firmware_host/base/printable.h"
#include "firmware_host/base/trimmed.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace frustumscreen::folder {

bool read_language(settings::TableReader& table, std::string_view key, std::string& language) {
    const std::optional<std::string> usual =
        pack::has_language_form(language) ? settings::parse_language_tag(language) : std::nullopt;
    if (!usual) {
        table.refuse("folder.language", key,
                     fmt::format("is for \"{}\"; allowed are {}", printable(language, 40),
                                 settings::allowed_language_tags));
        return false;
    }
    language = *usual;
    return true;
}

void read_labels(settings::TableReader& table, std::string_view key, std::vector<pack::PackLabel>& labels) {
    std::vector<std::pair<std::string, std::string>> written;
    table.named_texts(key, written, pack::max_languages);
    for (auto& [tag, text] : written) {
        std::string language = tag;
        if (!read_language(table, key, language)) {
            return;
        }
        const bool is_second = std::any_of(labels.begin(), labels.end(), [&](const pack::PackLabel& each) {
            return each.language == language;
        });
        table.require("folder.label_twice", !is_second, key,
                      fmt::format("has \"{}\" twice; allowed is each language once", language));
        const std::optional<std::string> fault = pack::fault_of_text(text, pack::TextShape::Line);
        table.require("folder.label_text", !fault, key,
                      fmt::format("in {} {}", language, fault.value_or("")));
        text = std::string(trimmed(text));
        table.require("folder.label_empty", !text.empty(), key,
                      fmt::format("in {} is empty; write a word for what is there", language));
        labels.push_back({std::move(language), std::move(text)});
    }
}

} // namespace frustumscreen::folder
