/// Reads little-endian numbers from bytes and appends them to bytes. A read past the end gives zeros and sets
/// an error that stays.
///
/// Threads  values; any.
#pragma once

#include "firmware_host/base/file.h"

#include <bit>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace frustumscreen {

static_assert(std::endian::native == std::endian::little, "files are little-endian; so must the machine be");

class ByteReader {
public:
    explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    /// The next number; zero past the end, and `ok` is false from then on.
    template <typename T> [[nodiscard]] T read() {
        static_assert(std::is_trivially_copyable_v<T>);
        T value{};
        if (bytes_.size() < sizeof(T)) {
            ok_ = false;
            bytes_ = {};
            return value;
        }
        std::memcpy(&value, bytes_.data(), sizeof(T));
        bytes_ = bytes_.subspan(sizeof(T));
        return value;
    }
    /// The next `count` numbers; none past the end.
    template <typename T> [[nodiscard]] std::vector<T> read_all(std::size_t count) {
        static_assert(std::is_trivially_copyable_v<T>);
        if (count > bytes_.size() / sizeof(T)) {
            ok_ = false;
            bytes_ = {};
            return {};
        }
        std::vector<T> values(count);
        if (count > 0) {
            std::memcpy(values.data(), bytes_.data(), count * sizeof(T));
            bytes_ = bytes_.subspan(count * sizeof(T));
        }
        return values;
    }
    [[nodiscard]] std::size_t left() const { return bytes_.size(); }
    [[nodiscard]] bool ok() const { return ok_; }

private:
    std::span<const std::byte> bytes_;
    bool ok_ = true;
};

template <typename T> void append(Bytes& bytes, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t at = bytes.size();
    bytes.resize(at + sizeof(T));
    std::memcpy(bytes.data() + at, &value, sizeof(T));
}
template <typename T> void append_all(Bytes& bytes, const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (!values.empty()) {
        const std::size_t at = bytes.size();
        bytes.resize(at + values.size() * sizeof(T));
        std::memcpy(bytes.data() + at, values.data(), values.size() * sizeof(T));
    }
}

} // namespace frustumscreen
