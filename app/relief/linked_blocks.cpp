#include "app/relief/linked_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace frustumscreen::relief {

namespace {

constexpr std::size_t corners_of_block = std::size_t{block_corners} * block_corners;
constexpr float no_height = std::numeric_limits<float>::quiet_NaN();

constexpr std::size_t corner_at(int column, int row) {
    return static_cast<std::size_t>(row) * block_corners + static_cast<std::size_t>(column);
}

/// A block that is being filled with cells of one connected layer.
struct OpenBlock {
    std::uint64_t mask = 0;
    std::array<std::uint32_t, corners_of_block> crossing{};
    std::array<float, corners_of_block> w{};
    std::array<glm::u8vec4, corners_of_block> guess{}; ///< colours for corners without a crossing; alpha 0:
                                                       ///< none
    std::array<std::uint64_t, std::size_t{block_cells} * block_cells>
        cover{}; ///< of each cell; 0 if the cell does not exist

    OpenBlock() {
        crossing.fill(no_crossing);
        w.fill(no_height);
    }

    /// Number of corners that the cell shares with the block; nullopt if they contradict. Guessed corners
    /// agree if they are close together; they only count if `guessed`.
    [[nodiscard]] std::optional<int> shared(const LinkedCell& cell, int column, int row, bool guessed) const {
        constexpr float together = 0.25F; // texels
        if ((mask >> (row * block_cells + column) & 1U) != 0) {
            return std::nullopt;
        }
        int same = 0;
        for (int k = 0; k < 4; ++k) {
            const std::size_t at = corner_at(column + (k & 1), row + (k >> 1));
            const auto corner = static_cast<std::size_t>(k);
            if (std::isnan(w[at])) {
                continue;
            }
            const bool both_known = crossing[at] != no_crossing && cell.crossing[corner] != no_crossing;
            if (both_known ? crossing[at] != cell.crossing[corner]
                           : std::abs(w[at] - cell.w[corner]) > together) {
                return std::nullopt;
            }
            same += both_known || guessed ? 1 : 0;
        }
        return same;
    }

    void add(const LinkedCell& cell, int column, int row) {
        const int number = row * block_cells + column;
        mask |= std::uint64_t{1} << number;
        cover[static_cast<std::size_t>(number)] = cell.cover;
        for (int k = 0; k < 4; ++k) {
            const std::size_t at = corner_at(column + (k & 1), row + (k >> 1));
            const auto corner = static_cast<std::size_t>(k);
            if (crossing[at] == no_crossing && (std::isnan(w[at]) || cell.crossing[corner] != no_crossing)) {
                crossing[at] = cell.crossing[corner];
                w[at] = cell.w[corner];
                guess[at] = cell.colour;
            }
        }
    }

    /// Joins the other block if no cell or corner contradicts, and they touch or are at about the same
    /// height.
    bool join(const OpenBlock& other, bool apart) {
        constexpr float the_same = 0.02F; // texels
        if ((mask & other.mask) != 0) {
            return false;
        }
        bool touch = false;
        for (std::size_t k = 0; k < corners_of_block; ++k) {
            if (!std::isnan(w[k]) && !std::isnan(other.w[k])) {
                if (std::abs(w[k] - other.w[k]) > the_same) {
                    return false;
                }
                touch = true;
            }
        }
        if (!touch && !(apart && lies_with(other))) {
            return false;
        }
        for (std::size_t k = 0; k < corners_of_block; ++k) {
            if (std::isnan(w[k])) {
                w[k] = other.w[k];
                crossing[k] = other.crossing[k];
                guess[k] = other.guess[k];
            }
        }
        mask |= other.mask;
        for (std::size_t k = 0; k < cover.size(); ++k) {
            cover[k] |= other.cover[k];
        }
        return true;
    }

private:
    [[nodiscard]] glm::vec2 heights() const; ///< lowest, highest
    /// A block of both is hardly deeper than one of either: the cost of rasterizing it grows with its depth.
    [[nodiscard]] bool lies_with(const OpenBlock& other) const;
};

glm::vec2 OpenBlock::heights() const {
    glm::vec2 range(std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity());
    for (const float height : w) {
        if (!std::isnan(height)) {
            range = {std::min(range.x, height), std::max(range.y, height)};
        }
    }
    return range;
}

bool OpenBlock::lies_with(const OpenBlock& other) const {
    constexpr float deepest = 4.0F; // texels
    const glm::vec2 a = heights();
    const glm::vec2 b = other.heights();
    return std::max(a.y, b.y) - std::min(a.x, b.x) < deepest;
}

/// All layers at one block's position.
std::vector<OpenBlock> fill_blocks(CellLinker& linker, int column0, int row0) {
    std::vector<OpenBlock> blocks;
    for (int row = 0; row < block_cells; ++row) {
        for (int column = 0; column < block_cells; ++column) {
            for (const LinkedCell& cell : linker.link(column0 + column, row0 + row)) {
                OpenBlock* into = nullptr;
                for (const bool guessed : {false, true}) {
                    for (OpenBlock& block : blocks) {
                        into = into == nullptr && block.shared(cell, column, row, guessed).value_or(0) > 0
                                   ? &block
                                   : into;
                    }
                }
                (into != nullptr ? *into : blocks.emplace_back()).add(cell, column, row);
            }
        }
    }
    for (const bool apart : {false, true}) {
        for (std::size_t a = 0; a < blocks.size(); ++a) {
            for (std::size_t b = a + 1; b < blocks.size();) {
                if (blocks[a].join(blocks[b], apart)) {
                    blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(b));
                    b = a + 1; // blocks that did not touch before may touch now
                } else {
                    ++b;
                }
            }
        }
    }
    return blocks;
}

/// The plane w0 + w_u i + w_v j closest to the heights.
glm::dvec3 fit_plane(const OpenBlock& block) {
    glm::dmat3 normal(1e-9); // a single row of corners has no slope across
    glm::dvec3 sum(0.0);
    for (int row = 0; row < block_corners; ++row) {
        for (int column = 0; column < block_corners; ++column) {
            const float w = block.w[corner_at(column, row)];
            if (!std::isnan(w)) {
                const glm::dvec3 at(1.0, column, row);
                normal += glm::outerProduct(at, at);
                sum += static_cast<double>(w) * at;
            }
        }
    }
    return glm::inverse(normal) * sum;
}

/// Fills the corners that no cell uses with the mean of their neighbours, so that no undefined value is read.
template <typename Value, typename Known>
void fill_gaps(std::array<Value, corners_of_block>& values, Known known) {
    std::array<bool, corners_of_block> has{};
    for (std::size_t k = 0; k < corners_of_block; ++k) {
        has[k] = known(k);
    }
    for (bool again = true; again;) {
        again = false;
        const std::array<bool, corners_of_block> had = has;
        for (int row = 0; row < block_corners; ++row) {
            for (int column = 0; column < block_corners; ++column) {
                const std::size_t at = corner_at(column, row);
                if (had[at]) {
                    continue;
                }
                Value sum{};
                float count = 0.0F;
                for (int y = std::max(row - 1, 0); y <= std::min(row + 1, block_cells); ++y) {
                    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, block_cells); ++x) {
                        if (had[corner_at(x, y)]) {
                            sum += values[corner_at(x, y)];
                            count += 1.0F;
                        }
                    }
                }
                if (count > 0.0F) {
                    values[at] = sum / count;
                    has[at] = again = true;
                }
            }
        }
    }
}

void add_colours(DirectionBlocks& into, const OpenBlock& open, const GridCrossings& grid) {
    std::array<glm::vec4, corners_of_block> colours{};
    for (std::size_t k = 0; k < corners_of_block; ++k) {
        colours[k] = glm::vec4(open.crossing[k] != no_crossing ? grid.crossings[open.crossing[k]].colour
                                                               : open.guess[k]);
    }
    fill_gaps(colours, [&](std::size_t k) { return colours[k].a > 0.0F; });
    for (const glm::vec4& colour : colours) {
        into.colours.emplace_back(glm::u8vec4(colour + 0.5F));
    }
}

/// Extents and gradients of the existing cells.
void set_cells(ReliefBlock& block, const std::array<float, corners_of_block>& residual) {
    block.cells = {block_cells, 0, block_cells, 0};
    block.gradient_u =
        block.gradient_v = {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
    const auto widen = [](glm::vec2& range, float value) {
        range = {std::min(range.x, value), std::max(range.y, value)};
    };
    for (int row = 0; row < block_cells; ++row) {
        for (int column = 0; column < block_cells; ++column) {
            if ((block.mask >> (row * block_cells + column) & 1U) == 0) {
                continue;
            }
            const auto at = [&](int i, int j) { return residual[corner_at(column + i, row + j)]; };
            widen(block.gradient_u, at(1, 0) - at(0, 0));
            widen(block.gradient_u, at(1, 1) - at(0, 1));
            widen(block.gradient_v, at(0, 1) - at(0, 0));
            widen(block.gradient_v, at(1, 1) - at(1, 0));
            const auto u = static_cast<std::uint8_t>(column);
            const auto v = static_cast<std::uint8_t>(row);
            block.cells = {
                std::min(block.cells[0], u), std::max(block.cells[1], static_cast<std::uint8_t>(u + 1)),
                std::min(block.cells[2], v), std::max(block.cells[3], static_cast<std::uint8_t>(v + 1))};
        }
    }
}

void add_cuts(DirectionBlocks& into, ReliefBlock& block, const OpenBlock& open) {
    block.first_cover = static_cast<std::uint32_t>(into.covers.size());
    for (std::size_t k = 0; k < open.cover.size(); ++k) {
        if (open.cover[k] != 0 && open.cover[k] != ~std::uint64_t{0}) {
            block.cut |= std::uint64_t{1} << k;
            into.covers.push_back(open.cover[k]);
        }
    }
}

void add_block(DirectionBlocks& into, const OpenBlock& open, const GridCrossings& grid, int column0,
               int row0) {
    const glm::dvec3 plane = fit_plane(open);
    ReliefBlock block;
    block.u0 = static_cast<float>(column0);
    block.v0 = static_cast<float>(row0);
    block.w0 = static_cast<float>(plane.x);
    block.w_u = static_cast<float>(plane.y);
    block.w_v = static_cast<float>(plane.z);
    block.mask = open.mask;
    std::array<float, corners_of_block> residual{};
    float low = std::numeric_limits<float>::infinity();
    float high = -low;
    for (int row = 0; row < block_corners; ++row) {
        for (int column = 0; column < block_corners; ++column) {
            const std::size_t at = corner_at(column, row);
            if (!std::isnan(open.w[at])) {
                const double on_plane = plane.x + plane.y * column + plane.z * row;
                residual[at] = static_cast<float>(static_cast<double>(open.w[at]) - on_plane);
                low = std::min(low, residual[at]);
                high = std::max(high, residual[at]);
            }
        }
    }
    fill_gaps(residual, [&](std::size_t k) { return !std::isnan(open.w[k]); });
    constexpr float min_step = 1e-6F;
    block.residual_low = low;
    block.residual_step = std::max(min_step, (high - low) / 255.0F);
    set_cells(block, residual);
    add_cuts(into, block, open);
    const auto code = [&](int column, int row) {
        const float steps = (residual[corner_at(column, row)] - low) / block.residual_step;
        return static_cast<std::uint32_t>(std::clamp(std::lround(steps), 0L, 255L));
    };
    for (int row = 0; row < block_cells; ++row) {
        for (int column = 0; column < block_cells; ++column) {
            into.corner_codes.push_back(code(column, row) | code(column + 1, row) << 8U |
                                        code(column, row + 1) << 16U | code(column + 1, row + 1) << 24U);
        }
    }
    add_colours(into, open, grid);
    into.blocks.push_back(block);
}

} // namespace

void DirectionBlocks::append(const DirectionBlocks& other) {
    const auto before = static_cast<std::uint32_t>(covers.size());
    const auto first = static_cast<std::ptrdiff_t>(blocks.size());
    covers.insert(covers.end(), other.covers.begin(), other.covers.end());
    blocks.insert(blocks.end(), other.blocks.begin(), other.blocks.end());
    corner_codes.insert(corner_codes.end(), other.corner_codes.begin(), other.corner_codes.end());
    colours.insert(colours.end(), other.colours.begin(), other.colours.end());
    std::for_each(blocks.begin() + first, blocks.end(),
                  [before](ReliefBlock& block) { block.first_cover += before; });
}

void link_blocks(DirectionBlocks& into, CellLinker& linker, const GridCrossings& grid, int column0,
                 int row0) {
    for (const OpenBlock& open : fill_blocks(linker, column0, row0)) {
        add_block(into, open, grid, column0, row0);
    }
}

} // namespace frustumscreen::relief
