/// Received bytes that are not parsed yet, in memory of fixed size.
///
/// Threads  one caller; allocates nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <span>

namespace frustumscreen::tracker {

class StreamBuffer {
public:
    static constexpr std::size_t capacity = 8192;

    /// Appends as many of `bytes` as fit; returns their number.
    std::size_t append(std::span<const std::byte> bytes) {
        const std::size_t count = std::min(bytes.size(), capacity - size_);
        if (count > 0) {
            std::memcpy(bytes_.data() + size_, bytes.data(), count);
        }
        size_ += count;
        return count;
    }
    [[nodiscard]] std::span<const std::byte> bytes() const { return {bytes_.data(), size_}; }
    void drop(std::size_t count) {
        count = std::min(count, size_);
        std::memmove(bytes_.data(), bytes_.data() + count, size_ - count);
        size_ -= count;
    }
    void clear() { size_ = 0; }

private:
    std::array<std::byte, capacity> bytes_{};
    std::size_t size_ = 0;
};

} // namespace frustumscreen::tracker
