/// One byte for each corner of a relief's block, as FORMAT.md stores it: what the corner adds to the one on its left,
/// the first of a row to the one above, modulo 256. Neighbours are similar, so the differences pack well.
///
/// Threads  pure; any.
#pragma once

#include "app/relief/block_relief.h"
#include "firmware_host/base/byte_reader.h"
#include "firmware_host/base/file.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace frustumscreen::pack {

inline constexpr std::size_t plane_corners = std::size_t{relief::block_corners} * relief::block_corners;
using Plane = std::array<std::uint8_t, plane_corners>;

/// The corner that a corner is stored relative to.
inline std::size_t corner_before(std::size_t corner) {
    return corner % relief::block_corners > 0 ? corner - 1 : corner - relief::block_corners;
}

inline void append_plane(Bytes& bytes, const Plane& values) {
    for (std::size_t k = 0; k < plane_corners; ++k) {
        append(bytes, static_cast<std::uint8_t>(values.at(k) - (k > 0 ? values.at(corner_before(k)) : 0)));
    }
}

inline Plane read_plane(ByteReader& reader) {
    Plane values{};
    for (std::size_t k = 0; k < plane_corners; ++k) {
        values.at(k) = static_cast<std::uint8_t>(reader.read<std::uint8_t>() +
                                                 (k > 0 ? values.at(corner_before(k)) : 0));
    }
    return values;
}

} // namespace frustumscreen::pack
