#include "app/library/exhibit_file.h"

#include "app/pack/pack_text.h"
#include "app/pack/signature/signature.h"
#include "app/settings/language_tag.h"
#include "app/settings/toml_file.h"
#include "firmware_host/base/calendar_day.h"
#include "firmware_host/base/printable.h"
#include "firmware_host/base/trimmed.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace frustumscreen::library {

namespace {

constexpr std::size_t max_keys = 16; ///< in one file
constexpr std::size_t max_attract_texts = 64;
constexpr std::size_t max_key_name_bytes = 100;

void read_ids(settings::TableReader& table, std::string_view key, std::vector<std::string>& ids) {
    table.texts(key, ids, max_installed_packs);
    std::set<std::string_view> seen;
    for (const std::string& id : ids) {
        table.require("exhibit_file.id", pack::is_artifact_id(id), key,
                      fmt::format("names \"{}\"; allowed are ids as in artifact.toml: 1 to 64 of a-z 0-9 . _ "
                                  "-, a letter or a digit first",
                                  printable(id, 40)));
        table.require("exhibit_file.id_twice", seen.insert(id).second, key,
                      fmt::format("names \"{}\" twice; allowed is each id once", printable(id, 64)));
    }
}

void read_attract(settings::TableReader& table, ExhibitFile& file) {
    std::vector<std::pair<std::string, std::string>> texts;
    table.named_texts("attract", texts, max_attract_texts);
    if (!table.has("attract")) {
        return;
    }
    file.attract.emplace();
    for (const auto& [language, text] : texts) {
        const std::optional<std::string> usual =
            pack::has_language_form(language) ? settings::parse_language_tag(language) : std::nullopt;
        table.require("exhibit_file.language", usual.has_value(), "attract",
                      fmt::format("has \"{}\"; allowed are {}", printable(language, 40),
                                  settings::allowed_language_tags));
        const std::optional<std::string> fault = pack::fault_of_text(text, pack::TextShape::Line);
        table.require("exhibit_file.text", !fault, "attract",
                      fmt::format("in {} {}", printable(language, 40), fault.value_or("")));
        table.require("exhibit_file.text_empty", !trimmed(text).empty(), "attract",
                      fmt::format("in {} is empty; write a text or leave the line out", usual.value_or("")));
        const bool again =
            std::any_of(file.attract->begin(), file.attract->end(),
                        [&](const AttractText& other) { return other.language == usual.value_or(""); });
        table.require("exhibit_file.language_twice", !again, "attract",
                      fmt::format("has {} twice; allowed is each language once", usual.value_or("")));
        file.attract->push_back({usual.value_or(""), std::string(trimmed(text))});
    }
}

void read_key(settings::TableReader& table, CarriedKey& key) {
    table.any_text("name", key.name);
    table.require(
        "exhibit_file.key_name", !key.name.empty() && key.name == printable(key.name, max_key_name_bytes),
        "name",
        fmt::format("is missing or not a name; allowed is one line of 1 to {} bytes, such as \"2031\"",
                    max_key_name_bytes));
    table.any_text("public_key", key.public_key);
    const Result<pack::PublicKey> parsed = pack::parse_public_key(key.public_key);
    table.require("exhibit_file.public_key", parsed.has_value(), "public_key",
                  "is missing or not a public key; allowed is the second line of a file that "
                  "frustumscreen-pack keygen or minisign made, RW...");
    key.public_key = parsed ? pack::public_key_line(*parsed) : std::string();
    table.any_text("until", key.until);
    table.require("exhibit_file.until", key.until.empty() || parse_day(key.until), "until",
                  "is not a day; allowed is the key's last day as a text, \"2031-12-31\"");
}

void read_all(settings::TableReader& table, ExhibitFile& file) {
    read_ids(table, "order", file.order);
    table.flag("only", file.only, {});
    read_ids(table, "remove", file.remove);
    for (const std::string& id : file.remove) {
        const bool ordered = std::find(file.order.begin(), file.order.end(), id) != file.order.end();
        table.require("exhibit_file.removed_and_ordered", !ordered, "remove",
                      fmt::format("names \"{}\", which order names too; name it in one of them", id));
    }
    read_attract(table, file);
    table.tables("key", file.keys, max_keys, read_key, {});
}

} // namespace

Result<ExhibitFile> parse_exhibit_file(std::string_view text) {
    settings::ReadState state{
        .file = std::string(exhibit_file_name), .folder = {}, .lines = {}, .error = std::nullopt};
    ExhibitFile file;
    settings::read_toml(state, text, max_exhibit_file_bytes, [&](const toml::table& root) {
        settings::TableReader keys(state, &root, "");
        read_all(keys, file);
        keys.finish(); // a misspelt key is reported before a missing one
        keys.require("exhibit_file.only", !file.only || !file.order.empty(), "only",
                     "would remove every pack, because order names none; write order = [\"id\", ...]");
    });
    if (state.error) {
        return tl::unexpected<Error>(*std::move(state.error));
    }
    return file;
}

} // namespace frustumscreen::library
