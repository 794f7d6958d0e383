/// Halves a picture, several times, while its rows arrive from the top: what `half_size` makes of a picture that never
/// lies in memory whole.
///
/// Colour   8-bit sRGB, averaged by area in linear light.
/// Memory   the shrunk picture, and a row for each halving.
/// Threads  one.
#pragma once

#include "app/image/image.h"

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace frustumscreen::image {

/// The size after `halvings`: each side is rounded down, and has at least one texel.
[[nodiscard]] glm::ivec2 halved_size(const glm::ivec2& size, int halvings);

class RowShrinker {
public:
    RowShrinker(const glm::ivec2& size, int halvings);
    /// The next row, of the whole picture's width. As many rows as the picture is high are taken.
    void add(std::span<const glm::u8vec4> row);
    /// The shrunk picture; rows that did not arrive are transparent black.
    [[nodiscard]] Image8 take() { return std::move(shrunk_); }

private:
    /// The texels of one row or column that a texel of half the size covers, and the share of each.
    struct Covered {
        int first = 0;
        int count = 0;
        std::array<float, 3> share{};
    };
    struct Halving {
        std::vector<Covered> columns, rows;
        std::size_t arrived = 0;       ///< rows
        std::size_t finished = 0;      ///< rows of the half
        std::vector<glm::vec4> sums;   ///< of the row that comes next
        std::vector<glm::u8vec4> made; ///< the row that was finished last
    };
    [[nodiscard]] static std::vector<Covered> coverage(int size, int half);
    static void add_share(std::span<const glm::u8vec4> row, float share, const std::vector<Covered>& columns,
                          std::vector<glm::vec4>& sums);
    /// Adds a row before the halving `k`.
    void add(std::span<const glm::u8vec4> row, std::size_t k);
    void keep(std::span<const glm::u8vec4> row);

    std::vector<Halving> halvings_;
    Image8 shrunk_;
    std::size_t kept_ = 0; ///< texels
};

} // namespace frustumscreen::image
