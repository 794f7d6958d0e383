#include "app/library/set_file.h"

#include "app/library/json_document.h"
#include "app/pack/container/sha256.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace frustumscreen::library {

namespace {

constexpr std::string_view first_words = "frustumscreen-set 1 ";
constexpr std::size_t hash_digits = 64;
constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();
constexpr std::size_t max_attract_texts = 64;

void set_fields(auto& fields, auto& set) {
    fields.whole("number", set.number, no_limit);
    fields.objects("packs", set.packs, max_installed_packs, [](auto& item, auto& pack) {
        item.text("file", pack.file);
        item.text("id", pack.id);
        item.text("title", pack.title);
        item.whole("serial", pack.serial, no_limit);
        item.text("sha256", pack.sha256);
        item.whole("bytes", pack.bytes, no_limit);
        item.text("manifest_sha256", pack.manifest_sha256);
    });
    fields.objects("attract", set.attract, max_attract_texts, [](auto& item, auto& text) {
        item.text("language", text.language);
        item.text("text", text.text);
    });
}

void file_fields(auto& fields, auto& file) {
    const auto set = [](auto& item, auto& value) { set_fields(item, value); };
    fields.object("set", [&](auto& item) { set_fields(item, file.choice.set); });
    fields.object_or_null("last_good", file.choice.last_good, set);
    fields.object_or_null("before", file.before, set);
    fields.whole("exhibit_serial", file.exhibit_serial, no_limit);
    fields.text("exhibit_sha256", file.exhibit_sha256);
    fields.text("latest_day", file.latest_day);
    fields.objects("serials", file.serials, max_accepted_serials, [](auto& item, auto& each) {
        item.text("id", each.id);
        item.whole("serial", each.serial, no_limit);
    });
    fields.objects("keys", file.keys, max_carried_keys, [](auto& item, auto& key) {
        item.text("name", key.name);
        item.text("public_key", key.public_key);
        item.text("until", key.until);
        item.text("signer", key.signer);
        item.text("since", key.since);
    });
}

/// True if each file's name is its hash, so that it cannot lead out of the folder.
bool names_are_hashes(const InstalledSet& set) {
    return std::all_of(set.packs.begin(), set.packs.end(), [](const InstalledPack& pack) {
        return is_sha256_text(pack.sha256) && pack.file == installed_file_name(pack.sha256);
    });
}

} // namespace

bool SetFile::operator==(const SetFile& other) const {
    return choice.set == other.choice.set && choice.last_good == other.choice.last_good &&
           before == other.before && exhibit_serial == other.exhibit_serial &&
           exhibit_sha256 == other.exhibit_sha256 && latest_day == other.latest_day &&
           serials == other.serials && keys == other.keys;
}

bool is_sha256_text(std::string_view text) {
    return text.size() == hash_digits && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

std::string installed_file_name(std::string_view sha256) {
    return fmt::format("{}/{}.fspack", packs_folder_name, sha256);
}

Result<SetFile> parse_set_file(std::string_view text) {
    const std::size_t line_end = first_words.size() + hash_digits;
    if (!text.starts_with(first_words) || text.size() <= line_end || text[line_end] != '\n') {
        return bad_input("set.first_line",
                         "its first line is not 'frustumscreen-set 1 HASH'; it is damaged, or of a newer "
                         "FrustumScreen");
    }
    const std::string_view body = text.substr(line_end + 1);
    if (text.substr(first_words.size(), hash_digits) != pack::sha256_hex(as_bytes(body))) {
        return bad_input("set.wrong_hash", "it does not match the hash in its first line; it is damaged");
    }
    TRY(SetFile file, parse_document<SetFile>(body, "the set", max_set_file_bytes,
                                              [](auto& fields, auto& value) { file_fields(fields, value); }));
    const InstalledSet none;
    if (!names_are_hashes(file.choice.set) || !names_are_hashes(file.choice.last_good.value_or(none)) ||
        !names_are_hashes(file.before.value_or(none))) {
        return bad_input("set.wrong_name", "it names a file whose name is not its hash; it is damaged");
    }
    return file;
}

std::string write_set_file(const SetFile& file) {
    const std::string body =
        write_document(file, [](auto& fields, auto& value) { file_fields(fields, value); });
    return fmt::format("{}{}\n{}", first_words, pack::sha256_hex(as_bytes(body)), body);
}

} // namespace frustumscreen::library
