/// The state of a device in one plain sentence for the person next to it, as a value of fixed size.
///
/// `Sentence` cuts a text that is too long between two UTF-8 characters, because systemd rejects a partial
/// character. `SharedSentence` carries the latest one from the device's thread to the exhibit's.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <mutex>
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

/// Threads  one sets, one reads; reading never waits.
class SharedSentence {
public:
    explicit SharedSentence(std::string_view text) : latest_(text) {}
    void set(std::string_view text) {
        const std::lock_guard lock(mutex_);
        latest_ = Sentence(text);
    }
    /// Leaves `sentence` unchanged while the other side is setting one.
    void read(Sentence& sentence) const {
        if (const std::unique_lock lock(mutex_, std::try_to_lock); lock.owns_lock()) {
            sentence = latest_;
        }
    }

private:
    mutable std::mutex mutex_;
    Sentence latest_;
};

} // namespace frustumscreen
