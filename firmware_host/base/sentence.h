/// The state of a device in one plain sentence for the person next to it, as a value of fixed size.
///
/// `Sentence` cuts what is too long between two UTF-8 characters: systemd refuses half a character.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace frustumscreen {

class Sentence {
public:
    static constexpr std::size_t longest = 240; ///< bytes

    Sentence() = default;
    explicit Sentence(std::string_view text) : length_(fitting(text)) { text.copy(text_.data(), length_); }
    [[nodiscard]] std::string_view view() const { return {text_.data(), length_}; }
    [[nodiscard]] bool operator==(const Sentence& other) const { return view() == other.view(); }

private:
    /// Number of bytes of `text` that fit, in whole characters.
    [[nodiscard]] static constexpr std::size_t fitting(std::string_view text) {
        std::size_t end = std::min(text.size(), longest);
        while (end > 0 && end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) {
            --end; // this byte continues a character
        }
        return end;
    }

    std::array<char, longest> text_{};
    std::size_t length_ = 0;
};

} // namespace frustumscreen
