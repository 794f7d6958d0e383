#include "app/programs/import/listed_keys.h"

#include "app/library/trusted_keys.h"
#include "firmware_host/base/calendar_day.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::programs {

namespace {

std::string id_of(const std::string& line) {
    const Result<pack::PublicKey> key = pack::parse_public_key(line);
    return key ? pack::text_of_key_id(key->id) : std::string();
}

} // namespace

std::vector<ListedKey> list_keys(std::span<const pack::TrustedKey> settings,
                                 std::span<const library::CarriedKey> carried) {
    std::vector<ListedKey> listed;
    for (const pack::TrustedKey& key : settings) {
        listed.push_back({.name = key.name,
                          .id = pack::text_of_key_id(key.key.id),
                          .until = key.until ? text_of_day(*key.until) : "",
                          .from = "",
                          .since = "",
                          .counts = true});
    }
    const std::vector<pack::TrustedKey> counting = library::trusted_keys(settings, carried);
    const std::span<const pack::TrustedKey> behind = std::span(counting).subspan(settings.size());
    for (const library::CarriedKey& key : carried) {
        const bool counts = std::any_of(behind.begin(), behind.end(), [&](const pack::TrustedKey& each) {
            return pack::public_key_line(each.key) == key.public_key;
        });
        listed.push_back({.name = key.name,
                          .id = id_of(key.public_key),
                          .until = key.until,
                          .from = id_of(key.signer),
                          .since = key.since,
                          .counts = counts});
    }
    return listed;
}

nlohmann::ordered_json json_of(const ListedKey& key, bool knows_settings) {
    nlohmann::ordered_json json{
        {"name", key.name}, {"id", key.id}, {"until", key.until}, {"from", key.from}, {"since", key.since}};
    json["counts"] = knows_settings ? nlohmann::ordered_json(key.counts) : nlohmann::ordered_json(nullptr);
    return json;
}

std::string text_of(const ListedKey& key, bool knows_settings) {
    const std::string from =
        key.from.empty()
            ? "of the settings"
            : fmt::format("brought{} by a set signed with {}{}", key.since.empty() ? "" : " on " + key.since,
                          key.from, key.counts || !knows_settings ? "" : ", which is no longer trusted");
    return fmt::format("key {} ({}), {}, {}\n", printable(key.name, 100), key.id,
                       key.until.empty() ? "no end" : "until " + key.until, from);
}

} // namespace frustumscreen::programs
