/// set.txt: the installed set, the set to go back to, and what the importer must never forget.
///
/// File     first line `frustumscreen-set 1 SHA256`, the hash of all bytes that follow; they are JSON.
/// Threads  pure; any.
/// Errors   one sentence: the file is not as described above. None of its values is used then.
#pragma once

#include "app/library/installed_set.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::library {

/// The highest serial that was ever taken of an artifact; a lower one is refused.
struct AcceptedSerial {
    std::string id;
    std::uint64_t serial = 0;
    [[nodiscard]] bool operator==(const AcceptedSerial&) const = default;
};
/// A key that a signed set brought; trusted_keys.h says when it counts.
struct CarriedKey {
    std::string name;
    std::string public_key; ///< as minisign writes it, one line
    std::string until;      ///< its last day, 2030-12-31; empty: none
    std::string signer{};   ///< public key of the signer of the set
    std::string since{};    ///< the day it came; empty: there was no clock
    [[nodiscard]] bool operator==(const CarriedKey&) const = default;
};
struct SetFile {
    SetChoice choice;
    /// The set shown before the last switch: its files stay, because the exhibit may still show them.
    std::optional<InstalledSet> before;
    std::uint64_t exhibit_serial = 0; ///< of the last signed exhibit.toml
    std::string exhibit_sha256{};     ///< of that file; empty: there was none
    std::string latest_day{};         ///< the latest day seen (trusted_keys.h); empty: none
    std::vector<AcceptedSerial> serials;
    std::vector<CarriedKey> keys;
    [[nodiscard]] bool operator==(const SetFile&) const;
};

inline constexpr std::size_t max_set_file_bytes = 16U << 20U;
inline constexpr std::size_t max_installed_packs = 1000;
inline constexpr std::size_t max_accepted_serials = 20000;
inline constexpr std::size_t max_carried_keys = 64;

[[nodiscard]] Result<SetFile> parse_set_file(std::string_view text);
[[nodiscard]] std::string write_set_file(const SetFile& file);

/// packs/SHA256.fspack
[[nodiscard]] std::string installed_file_name(std::string_view sha256);
[[nodiscard]] bool is_sha256_text(std::string_view text);

} // namespace frustumscreen::library
