/// Reads numbers from raw bytes, with bounds checked.
#pragma once

#include "assets_baked/bake/loaders/refusal.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>

namespace frustumscreen::bake {

using ByteView = std::span<const std::byte>;

/// The number at `offset`; refuses to read past the end.
template <typename T> [[nodiscard]] T load(ByteView bytes, std::size_t offset, std::endian order) {
    if (offset > bytes.size() || sizeof(T) > bytes.size() - offset) {
        refuse_cut_short("the data end at byte {}, {} more are needed at byte {}", bytes.size(), sizeof(T),
                         offset);
    }
    std::array<std::byte, sizeof(T)> raw{};
    std::memcpy(raw.data(), bytes.data() + offset, sizeof(T));
    if (order != std::endian::native) {
        std::reverse(raw.begin(), raw.end());
    }
    return std::bit_cast<T>(raw);
}
template <typename T> [[nodiscard]] T load_little(ByteView bytes, std::size_t offset) {
    return load<T>(bytes, offset, std::endian::little);
}

} // namespace frustumscreen::bake
