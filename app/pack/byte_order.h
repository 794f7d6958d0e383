/// Little-endian numbers in and out of bytes.
#pragma once

#include "firmware_host/base/file.h"

#include <bit>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace frustumscreen::pack_format {

static_assert(std::endian::native == std::endian::little, "parts are copied as they lie in memory");

template <typename Number> void append(Bytes& bytes, Number value) {
    static_assert(std::is_arithmetic_v<Number>);
    const std::size_t end = bytes.size();
    bytes.resize(end + sizeof value);
    std::memcpy(bytes.data() + end, &value, sizeof value);
}

template <typename Item> void append_all(Bytes& bytes, const std::vector<Item>& items) {
    static_assert(std::is_trivially_copyable_v<Item>);
    if (!items.empty()) {
        const std::size_t end = bytes.size();
        bytes.resize(end + items.size() * sizeof(Item));
        std::memcpy(bytes.data() + end, items.data(), items.size() * sizeof(Item));
    }
}

/// Reads on from the front; whoever reads has held the counts against the size before.
class ByteCursor {
public:
    explicit ByteCursor(std::span<const std::byte> bytes) : bytes_(bytes) {}
    [[nodiscard]] std::size_t left() const { return bytes_.size(); }

    template <typename Number> [[nodiscard]] Number take() {
        static_assert(std::is_arithmetic_v<Number>);
        Number value{};
        std::memcpy(&value, bytes_.data(), sizeof value);
        bytes_ = bytes_.subspan(sizeof value);
        return value;
    }
    template <typename Item> [[nodiscard]] std::vector<Item> take_all(std::size_t count) {
        static_assert(std::is_trivially_copyable_v<Item>);
        std::vector<Item> items(count);
        if (count > 0) {
            std::memcpy(items.data(), bytes_.data(), count * sizeof(Item));
            bytes_ = bytes_.subspan(count * sizeof(Item));
        }
        return items;
    }

private:
    std::span<const std::byte> bytes_;
};

} // namespace frustumscreen::pack_format
