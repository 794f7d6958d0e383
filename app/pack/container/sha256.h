/// SHA-256 (FIPS 180-4), by libsodium.
///
/// Threads  any; a Sha256 has one caller.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace frustumscreen::pack {

/// 64 hexadecimal digits, lower case.
[[nodiscard]] std::string sha256_hex(std::span<const std::byte> bytes);

/// Hash of bytes that arrive piece by piece.
class Sha256 {
public:
    Sha256();
    ~Sha256();
    Sha256(const Sha256&) = delete;
    Sha256& operator=(const Sha256&) = delete;

    void add(std::span<const std::byte> bytes);
    /// As sha256_hex; call once, last.
    [[nodiscard]] std::string hex();

private:
    struct State; ///< the library's state
    std::unique_ptr<State> state_;
};

} // namespace frustumscreen::pack
