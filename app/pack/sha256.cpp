#include "app/pack/sha256.h"

#include <sodium.h>

#include <array>

namespace frustumscreen {

std::string sha256_hex(std::span<const std::byte> bytes) {
    std::array<unsigned char, crypto_hash_sha256_BYTES> digest{};
    crypto_hash_sha256(digest.data(), reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    std::string text(2 * digest.size() + 1, '\0');
    sodium_bin2hex(text.data(), text.size(), digest.data(), digest.size());
    text.pop_back(); // sodium's terminator
    return text;
}

} // namespace frustumscreen
