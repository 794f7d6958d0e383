/// Secret keys in minisign's format, and signing with them. Only signers need this; no program of the exhibit
/// does.
///
/// Bytes    an untrusted comment, base64 of "Ed", "Sc" (scrypt) or zeros (not encrypted), "B2", salt (32),
///          scrypt's limits for operations and bytes of memory (8, 8), key id (8), Ed25519 secret key (64),
///          their BLAKE2b-256 checksum (32); the last three XORed with scrypt's output.
/// Memory   a key is wiped on destruction. With a password, reading and writing take the memory in the
///          limits: at most 1 GiB.
/// Threads  one caller.
/// Errors   one sentence: not a key, a wrong password, not enough memory.
/// Source   https://jedisct1.github.io/minisign/
/// Library  libsodium.
#pragma once

#include "app/pack/signature/signature.h"
#include "firmware_host/base/result.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace frustumscreen::pack {

/// Cost of each password attempt, for attackers and owners alike: scrypt's limits.
struct PasswordCost {
    std::uint64_t operations = 33554432;
    std::uint64_t memory_bytes = 1073741824;
};

class SecretKey {
public:
    /// Generates a new key.
    [[nodiscard]] static SecretKey make();
    ~SecretKey();
    SecretKey(SecretKey&& other) noexcept;
    SecretKey& operator=(SecretKey&&) = delete;

    [[nodiscard]] PublicKey public_key() const;
    /// The text of a `.minisig` file for `bytes`. `trusted_comment` is one line.
    [[nodiscard]] std::string sign(std::span<const std::byte> bytes, std::string_view trusted_comment) const;

private:
    friend Result<SecretKey> parse_secret_key(std::string_view, std::optional<std::string_view>);
    friend Result<std::string> write_secret_key(const SecretKey&, std::optional<std::string_view>,
                                                const PasswordCost&);
    SecretKey() = default;
    std::array<std::uint8_t, 8> id_{};
    std::array<std::uint8_t, 64> key_{};
};

/// Without a password the key is not encrypted.
[[nodiscard]] Result<std::string> write_secret_key(const SecretKey& key,
                                                   std::optional<std::string_view> password,
                                                   const PasswordCost& cost = {});
/// Errors: it is not a secret key.
[[nodiscard]] Result<bool> needs_password(std::string_view text);
[[nodiscard]] Result<SecretKey> parse_secret_key(std::string_view text,
                                                 std::optional<std::string_view> password);

} // namespace frustumscreen::pack
