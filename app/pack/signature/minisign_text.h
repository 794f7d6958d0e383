/// Common parts of minisign's files: lines, comment prefixes, numbers and keys in base64.
///
/// Threads  pure; any.
/// Source   https://jedisct1.github.io/minisign/
#pragma once

#include <sodium.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::pack::minisign {

inline constexpr std::string_view untrusted_prefix = "untrusted comment: ";
inline constexpr std::string_view trusted_prefix = "trusted comment: ";

/// Lines without their ends, of Unix or Windows. A final line break adds no empty line.
[[nodiscard]] inline std::vector<std::string_view> lines_of(std::string_view text, std::size_t most) {
    std::vector<std::string_view> lines;
    while (!text.empty() && lines.size() < most) {
        const std::size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
        if (line.ends_with('\r')) {
            line.remove_suffix(1);
        }
        lines.push_back(line);
    }
    return lines;
}

[[nodiscard]] inline std::string to_base64(std::span<const std::uint8_t> bytes) {
    std::string text(sodium_base64_ENCODED_LEN(bytes.size(), sodium_base64_VARIANT_ORIGINAL), '\0');
    sodium_bin2base64(text.data(), text.size(), bytes.data(), bytes.size(), sodium_base64_VARIANT_ORIGINAL);
    text.pop_back(); // sodium's terminator
    return text;
}

/// Exactly `Size` bytes in their only valid encoding, with padding. libsodium 1.0.18 also accepts bytes above
/// 127 as letters, so the result is encoded again and compared.
template <std::size_t Size>
[[nodiscard]] std::optional<std::array<std::uint8_t, Size>> from_base64(std::string_view text) {
    std::array<std::uint8_t, Size> bytes{};
    std::size_t count = 0;
    const bool read = sodium_base642bin(bytes.data(), bytes.size(), text.data(), text.size(), nullptr, &count,
                                        nullptr, sodium_base64_VARIANT_ORIGINAL) == 0;
    return read && count == Size && to_base64(bytes) == text ? std::optional(bytes) : std::nullopt;
}

/// Reads the pieces of a record in order.
class Pieces {
public:
    explicit Pieces(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
    template <std::size_t Size> [[nodiscard]] std::array<std::uint8_t, Size> take() {
        std::array<std::uint8_t, Size> piece{};
        std::copy_n(bytes_.begin(), Size, piece.begin());
        bytes_ = bytes_.subspan(Size);
        return piece;
    }

private:
    std::span<const std::uint8_t> bytes_;
};

} // namespace frustumscreen::pack::minisign
