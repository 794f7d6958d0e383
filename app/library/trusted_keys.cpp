#include "app/library/trusted_keys.h"

#include "firmware_host/base/calendar_day.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::library {

namespace {

constexpr std::chrono::days max_days_ahead(3653);

const pack::TrustedKey* find(std::span<const pack::TrustedKey> keys, const pack::PublicKey& key) {
    const auto found =
        std::find_if(keys.begin(), keys.end(), [&](const pack::TrustedKey& each) { return each.key == key; });
    return found != keys.end() ? &*found : nullptr;
}

bool had_ended(const pack::TrustedKey& key, std::optional<std::chrono::sys_days> day) {
    return key.until && day && *day > *key.until;
}

/// True if the signer of a key counts, among the keys found so far.
bool is_vouched_for(const CarriedKey& carried, std::span<const pack::TrustedKey> counting) {
    const Result<pack::PublicKey> signer = pack::parse_public_key(carried.signer);
    return signer && std::any_of(counting.begin(), counting.end(), [&](const pack::TrustedKey& each) {
               return each.key == *signer && !had_ended(each, parse_day(carried.since));
           });
}

} // namespace

std::vector<pack::TrustedKey> trusted_keys(std::span<const pack::TrustedKey> settings,
                                           std::span<const CarriedKey> carried) {
    std::vector<pack::TrustedKey> counting(settings.begin(), settings.end());
    for (bool is_longer = true; is_longer;) { // a key may stand behind the one that it signs for
        is_longer = false;
        for (const CarriedKey& each : carried) {
            const Result<pack::PublicKey> key = pack::parse_public_key(each.public_key);
            const std::optional<std::chrono::sys_days> until = parse_day(each.until);
            if (key && find(counting, *key) == nullptr && (until || each.until.empty()) &&
                is_vouched_for(each, counting)) {
                counting.push_back({each.name, *key, until});
                is_longer = true;
            }
        }
    }
    return counting;
}

Result<std::vector<CarriedKey>> with_brought_keys(std::vector<CarriedKey> carried,
                                                  std::span<const CarriedKey> brought,
                                                  const pack::Signer& signer,
                                                  std::span<const pack::TrustedKey> settings,
                                                  std::optional<std::chrono::sys_days> day) {
    const std::string signer_line = pack::public_key_line(signer.public_key);
    for (CarriedKey key : brought) {
        key.signer = signer_line;
        key.since = day ? text_of_day(*day) : "";
        const auto place = std::find_if(carried.begin(), carried.end(), [&](const CarriedKey& other) {
            return other.public_key == key.public_key;
        });
        if (place == carried.end()) {
            carried.push_back(std::move(key));
            continue;
        }
        if (place->name == key.name && place->until == key.until && place->signer == key.signer) {
            key.since = place->since; // the same key again
        }
        *place = std::move(key);
    }
    const std::vector<pack::TrustedKey> counting = trusted_keys(settings, carried);
    for (const CarriedKey& key : brought) {
        const Result<pack::PublicKey> parsed = pack::parse_public_key(key.public_key);
        if (!parsed || find(counting, *parsed) == nullptr || find(counting, signer.public_key) == nullptr) {
            return bad_input("keys.vouches_for_itself",
                             "it brings the key {} and is signed with it, or with one that it "
                             "vouches for; sign it with another key",
                             printable(key.name, 40));
        }
    }
    return carried;
}

std::optional<std::chrono::sys_days> signing_day(std::uint64_t serial) {
    constexpr std::uint64_t end_of_days_s = 253402300800; // 10000-01-01
    if (serial == 0 || serial >= end_of_days_s) {
        return std::nullopt;
    }
    return std::chrono::floor<std::chrono::days>(std::chrono::sys_seconds(std::chrono::seconds(serial)));
}

std::string latest_day(const std::string& latest, std::optional<std::chrono::sys_days> day) {
    const std::chrono::sys_days known = parse_day(latest).value_or(earliest_plausible_day);
    return day && *day > known && *day <= known + max_days_ahead ? text_of_day(*day) : latest;
}

std::optional<std::chrono::sys_days> day_here(std::optional<std::chrono::sys_days> clock,
                                              const std::string& latest) {
    return clock ? std::optional(std::max(*clock, parse_day(latest).value_or(*clock))) : std::nullopt;
}

} // namespace frustumscreen::library
