/// Signatures in minisign's format: `minisign -V` accepts ours, and we accept minisign's.
///
/// Bytes    signature: an untrusted comment, base64 of algorithm (2 bytes: "ED", over the BLAKE2b-512 hash;
///          "Ed", over the bytes themselves), key id (8) and Ed25519 signature (64), a trusted comment,
///          base64 of a signature over signature and trusted comment. Public key: an untrusted comment,
///          base64 of "Ed", key id (8) and key (32); the second line alone is accepted.
/// Serial   of the signed file, from the trusted comment: `serial:N`, otherwise `timestamp:N` (as minisign
///          writes it), fields separated by tabs, or by spaces if it has no tab. A higher serial replaces a
///          lower one.
/// Threads  pure; any.
/// Errors   one sentence for the person who holds the stick; a refusal also has its reason as a value.
/// Source   https://jedisct1.github.io/minisign/
/// Library  libsodium.
#pragma once

#include "firmware_host/base/result.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::pack {

struct PublicKey {
    std::array<std::uint8_t, 8> id{};
    std::array<std::uint8_t, 32> key{};
    [[nodiscard]] bool operator==(const PublicKey&) const = default;
};
/// Accepts a file of minisign's, or its second line.
[[nodiscard]] Result<PublicKey> parse_public_key(std::string_view text);
/// The second line, without a line break.
[[nodiscard]] std::string public_key_line(const PublicKey& key);
/// A public key file in minisign's format.
[[nodiscard]] std::string write_public_key(const PublicKey& key);
/// A key's id as minisign writes it: a number of at most 16 digits, upper case.
[[nodiscard]] std::string text_of_key_id(std::span<const std::uint8_t, 8> id);

/// Most keys that the settings or a folder may name.
inline constexpr std::size_t max_trusted_keys = 32;
/// One of the museum's keys.
struct TrustedKey {
    std::string name;
    PublicKey key;
    std::optional<std::chrono::sys_days> until; ///< its last day; nullopt: unlimited
    [[nodiscard]] bool operator==(const TrustedKey&) const = default;
};

/// Policy for packs without a signature. An existing signature must be valid in any case.
enum class UnsignedPacks : std::uint8_t { Refuse, Allow };

enum class SignatureFault : std::uint8_t {
    Unsigned,   ///< there is no signature
    Malformed,  ///< not in minisign's format, or without a serial
    UnknownKey, ///< made with a key that is not one of the museum's
    KeyEnded,   ///< the key's last day has passed
    Altered,    ///< not the signature of these bytes, or of its trusted comment
};
struct SignatureRefusal {
    SignatureFault fault;
    Error error;
};

/// The claims of an unverified signature, which anyone may have written: for reports, and for signing again.
struct SignatureClaim {
    std::string key_id;
    std::uint64_t serial = 0;
    std::string trusted_comment;
};
[[nodiscard]] Result<SignatureClaim> read_signature_claim(std::string_view signature);

struct Signer {
    std::string key; ///< its name
    std::uint64_t serial = 0;
    std::string trusted_comment;
    PublicKey public_key;
};
/// `signature`: the bytes of a `.minisig` file; nullopt: Unsigned. `today`: nullopt: no key has ended.
[[nodiscard]] tl::expected<Signer, SignatureRefusal>
check_signature(std::span<const std::byte> signed_bytes, std::optional<std::string_view> signature,
                std::span<const TrustedKey> keys, std::optional<std::chrono::sys_days> today);

} // namespace frustumscreen::pack
