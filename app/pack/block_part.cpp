#include "app/pack/block_part.h"

#include "app/pack/container/limits.h"
#include "app/pack/corner_planes.h"
#include "firmware_host/base/byte_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace frustumscreen::pack {

namespace {

constexpr std::array<char, 4> blocks_magic{'F', 'S', 'R', 'B'};
constexpr std::uint32_t blocks_version = 1;
constexpr std::size_t header_bytes = 24;
constexpr std::size_t grid_bytes = 32;
constexpr std::size_t corners = plane_corners;
constexpr std::size_t cells = std::size_t{relief::block_cells} * relief::block_cells;
constexpr std::uint32_t max_directions = 6;
constexpr double max_origin_box = 4.0;   ///< the box is 1 long
constexpr float max_texels_along = 1e6F; ///< of a height, or of its change from cell to cell
constexpr std::uint8_t opaque = 255;

/// A block's numbers in the order of the file. Each number is stored for all blocks before the next: similar values
/// pack better.
using Number = float& (*)(relief::ReliefBlock&);
constexpr std::array<Number, 9> numbers{
    [](relief::ReliefBlock& block) -> float& { return block.w0; },
    [](relief::ReliefBlock& block) -> float& { return block.w_u; },
    [](relief::ReliefBlock& block) -> float& { return block.w_v; },
    [](relief::ReliefBlock& block) -> float& { return block.residual_low; },
    [](relief::ReliefBlock& block) -> float& { return block.residual_step; },
    [](relief::ReliefBlock& block) -> float& { return block.gradient_u.x; },
    [](relief::ReliefBlock& block) -> float& { return block.gradient_u.y; },
    [](relief::ReliefBlock& block) -> float& { return block.gradient_v.x; },
    [](relief::ReliefBlock& block) -> float& { return block.gradient_v.y; },
};
constexpr std::size_t places_bytes = 2 * sizeof(std::uint16_t);
constexpr std::size_t planes = 4; ///< byte planes of the corners: height, red, green, blue
constexpr std::size_t block_bytes =
    places_bytes + numbers.size() * sizeof(float) + 2 * sizeof(std::uint64_t) + planes * corners;

/// The axes across and along a direction, as in pack.h.
relief::ReliefGrid grid_towards(std::uint32_t direction) {
    constexpr std::array<std::array<int, 3>, 3> axes{{{1, 2, 0}, {0, 2, 1}, {0, 1, 2}}};
    return {axes.at(direction / 2), direction % 2 == 0 ? 1.0 : -1.0, {}};
}

std::uint32_t direction_of(const relief::ReliefGrid& grid) {
    return 2 * static_cast<std::uint32_t>(grid.axis[2]) + (grid.sign < 0.0 ? 1 : 0);
}

/// Codes of the corners, from the words of the 64 cells; neighbouring cells share corners.
Plane codes_of(std::span<const std::uint32_t> cell_words) {
    Plane codes{};
    constexpr std::size_t cells = relief::block_cells;
    constexpr std::size_t corners = relief::block_corners;
    for (std::size_t row = 0; row < corners; ++row) {
        for (std::size_t column = 0; column < corners; ++column) {
            const std::size_t x = std::min(column, cells - 1);
            const std::size_t y = std::min(row, cells - 1);
            const std::size_t corner = column - x + 2 * (row - y);
            codes.at(row * corners + column) =
                static_cast<std::uint8_t>(cell_words[y * cells + x] >> 8U * corner);
        }
    }
    return codes;
}

void append_cell_words(const Plane& codes, std::vector<std::uint32_t>& words) {
    for (std::size_t row = 0; row < relief::block_cells; ++row) {
        for (std::size_t column = 0; column < relief::block_cells; ++column) {
            const std::size_t at = row * relief::block_corners + column;
            const auto code = [&](std::size_t k) { return std::uint32_t{codes.at(at + k)}; };
            words.push_back(code(0) | code(1) << 8U | code(relief::block_corners) << 16U |
                            code(relief::block_corners + 1) << 24U);
        }
    }
}

/// The range of columns and rows of the existing cells.
std::array<std::uint8_t, 4> extent_of(std::uint64_t mask) {
    std::array<std::uint8_t, 4> extent{relief::block_cells, 0, relief::block_cells, 0};
    for (std::uint8_t cell = 0; cell < cells; ++cell) {
        if ((mask >> cell & 1U) != 0) {
            const auto column = static_cast<std::uint8_t>(cell % relief::block_cells);
            const auto row = static_cast<std::uint8_t>(cell / relief::block_cells);
            extent = {std::min(extent[0], column), std::max(extent[1], static_cast<std::uint8_t>(column + 1)),
                      std::min(extent[2], row), std::max(extent[3], static_cast<std::uint8_t>(row + 1))};
        }
    }
    return extent;
}

struct Header {
    std::uint32_t texels = 0, directions = 0, blocks = 0, covers = 0;
};

Result<Header> read_header(std::span<const std::byte> bytes) {
    if (bytes.size() < header_bytes ||
        std::memcmp(bytes.data(), blocks_magic.data(), blocks_magic.size()) != 0) {
        return bad_input("blocks.no_magic", "it does not begin as relief blocks do (FSRB)");
    }
    ByteReader reader(bytes.subspan(blocks_magic.size()));
    if (const auto version = reader.read<std::uint32_t>(); version != blocks_version) {
        return bad_input("blocks.version", "its relief blocks have version {}, allowed is {}", version,
                         blocks_version);
    }
    Header header;
    header.texels = reader.read<std::uint32_t>();
    header.directions = reader.read<std::uint32_t>();
    header.blocks = reader.read<std::uint32_t>();
    header.covers = reader.read<std::uint32_t>();
    const auto within = [](std::uint32_t value, std::uint32_t most) { return value >= 1 && value <= most; };
    if (!within(header.texels, max_relief_texels) || !within(header.directions, max_directions) ||
        !within(header.blocks, max_relief_blocks)) {
        return bad_input("blocks.counts",
                         "it has {} texels, {} directions, {} blocks; allowed are 1 to {}, {}, {}",
                         header.texels, header.directions, header.blocks, max_relief_texels, max_directions,
                         max_relief_blocks);
    }
    const std::uint64_t needed = std::uint64_t{header.directions} * grid_bytes +
                                 std::uint64_t{header.blocks} * block_bytes +
                                 std::uint64_t{header.covers} * sizeof(std::uint64_t);
    if (needed != bytes.size() - header_bytes) {
        return bad_input("blocks.size", "{} directions and {} blocks need {} bytes, it has {}",
                         header.directions, header.blocks, needed, bytes.size() - header_bytes);
    }
    return header;
}

Result<void> read_grids(ByteReader& reader, const Header& header, relief::BlockRelief& relief) {
    std::uint64_t first = 0;
    std::uint32_t seen = 0; // bits
    for (std::uint32_t k = 0; k < header.directions; ++k) {
        const auto direction = reader.read<std::uint32_t>();
        const auto blocks = reader.read<std::uint32_t>();
        if (direction >= max_directions || (seen >> direction & 1U) != 0) {
            return bad_input("blocks.direction",
                             "its directions have the number {}; allowed are 0 to 5, each once", direction);
        }
        seen |= 1U << direction;
        relief::ReliefGrid grid = grid_towards(direction);
        for (int axis = 0; axis < 3; ++axis) {
            grid.origin_box[axis] = reader.read<double>();
            if (!(std::abs(grid.origin_box[axis]) <= max_origin_box)) { // false for NaN too
                return bad_input("blocks.origin", "direction {} begins beyond {} boxes", direction,
                                 max_origin_box);
            }
        }
        relief.grids.push_back(grid);
        relief.first_block.push_back(static_cast<std::uint32_t>(first));
        first += blocks;
        if (first > header.blocks) {
            return bad_input("blocks.too_many_of_direction", "its directions have more than its {} blocks",
                             header.blocks);
        }
    }
    if (first != header.blocks) {
        return bad_input("blocks.count_of_directions", "its directions have {} blocks in all, it has {}",
                         first, header.blocks);
    }
    relief.first_block.push_back(header.blocks);
    return {};
}

Result<void> check_block(relief::ReliefBlock& block, std::size_t k, std::uint32_t texels) {
    const auto sound = [&](Number number) {
        return std::abs(number(block)) <= max_texels_along;
    }; // false for NaN
    if (!std::all_of(numbers.begin(), numbers.end(), sound)) {
        return bad_input("blocks.not_finite", "block {} has a number that is not finite or is beyond {}", k,
                         max_texels_along);
    }
    if (block.residual_step <= 0.0F || block.gradient_u.x > block.gradient_u.y ||
        block.gradient_v.x > block.gradient_v.y || block.mask == 0 || (block.cut & ~block.mask) != 0) {
        return bad_input("blocks.step",
                         "block {} has a step of 0 or less, a gradient's range whose end is below its "
                         "beginning, no cell, or a cut in a cell that is not there",
                         k);
    }
    // A grid extends some cells beyond the box.
    const auto end = static_cast<float>(texels + 2 * relief::block_cells);
    if (block.u0 > end || block.v0 > end) {
        return bad_input("blocks.outside_grid", "block {} lies at ({}, {}), outside a grid of {} texels", k,
                         block.u0, block.v0, texels);
    }
    return {};
}

/// Reads which cells are cut, and checks the blocks.
Result<void> read_cuts(ByteReader& reader, const Header& header, relief::BlockRelief& relief) {
    std::uint64_t covers = 0;
    for (std::size_t k = 0; k < relief.blocks.size(); ++k) {
        relief::ReliefBlock& block = relief.blocks[k];
        block.cut = reader.read<std::uint64_t>();
        block.first_cover = static_cast<std::uint32_t>(covers);
        covers += static_cast<std::uint64_t>(std::popcount(block.cut));
        TRY_VOID(check_block(block, k, header.texels));
    }
    return covers == header.covers
               ? Result<void>()
               : bad_input("blocks.cut_cells", "its blocks cut {} cells, it has {}", covers, header.covers);
}

} // namespace

Bytes encode_blocks(const relief::BlockRelief& relief) {
    Bytes bytes;
    bytes.reserve(header_bytes + relief.grids.size() * grid_bytes + relief.blocks.size() * block_bytes);
    for (const char c : blocks_magic) {
        append(bytes, c);
    }
    append(bytes, blocks_version);
    append(bytes, static_cast<std::uint32_t>(std::lround(1.0F / relief.texel_box)));
    append(bytes, static_cast<std::uint32_t>(relief.grids.size()));
    append(bytes, static_cast<std::uint32_t>(relief.blocks.size()));
    append(bytes, static_cast<std::uint32_t>(relief.covers.size()));
    for (std::size_t k = 0; k < relief.grids.size(); ++k) {
        append(bytes, direction_of(relief.grids[k]));
        append(bytes, relief.first_block[k + 1] - relief.first_block[k]);
        for (int axis = 0; axis < 3; ++axis) {
            append(bytes, relief.grids[k].origin_box[axis]);
        }
    }
    for (const relief::ReliefBlock& block : relief.blocks) {
        append(bytes, static_cast<std::uint16_t>(std::lround(block.u0) / relief::block_cells));
    }
    for (const relief::ReliefBlock& block : relief.blocks) {
        append(bytes, static_cast<std::uint16_t>(std::lround(block.v0) / relief::block_cells));
    }
    for (const Number number : numbers) {
        for (relief::ReliefBlock block : relief.blocks) {
            append(bytes, number(block));
        }
    }
    for (const relief::ReliefBlock& block : relief.blocks) {
        append(bytes, block.mask);
    }
    for (const relief::ReliefBlock& block : relief.blocks) {
        append(bytes, block.cut);
    }
    for (std::size_t k = 0; k < relief.blocks.size(); ++k) {
        append_plane(bytes, codes_of(std::span(relief.corner_codes).subspan(k * cells, cells)));
    }
    for (int channel = 0; channel < 3; ++channel) {
        for (std::size_t k = 0; k < relief.blocks.size(); ++k) {
            Plane values{};
            for (std::size_t corner = 0; corner < corners; ++corner) {
                values.at(corner) = relief.colours[k * corners + corner][channel];
            }
            append_plane(bytes, values);
        }
    }
    append_all(bytes, relief.covers);
    return bytes;
}

Result<relief::BlockRelief> decode_blocks(std::span<const std::byte> bytes) {
    TRY(const Header header, read_header(bytes));
    relief::BlockRelief relief;
    relief.texel_box = static_cast<float>(1.0 / header.texels);
    ByteReader reader(bytes.subspan(header_bytes));
    TRY_VOID(read_grids(reader, header, relief));
    relief.blocks.resize(header.blocks);
    for (relief::ReliefBlock& block : relief.blocks) {
        block.u0 = static_cast<float>(relief::block_cells * reader.read<std::uint16_t>());
    }
    for (relief::ReliefBlock& block : relief.blocks) {
        block.v0 = static_cast<float>(relief::block_cells * reader.read<std::uint16_t>());
    }
    for (const Number number : numbers) {
        for (relief::ReliefBlock& block : relief.blocks) {
            number(block) = reader.read<float>();
        }
    }
    for (relief::ReliefBlock& block : relief.blocks) {
        block.mask = reader.read<std::uint64_t>();
        block.cells = extent_of(block.mask);
    }
    TRY_VOID(read_cuts(reader, header, relief));
    relief.corner_codes.reserve(cells * relief.blocks.size());
    for (std::size_t k = 0; k < relief.blocks.size(); ++k) {
        append_cell_words(read_plane(reader), relief.corner_codes);
    }
    relief.colours.assign(corners * relief.blocks.size(), glm::u8vec4(0, 0, 0, opaque));
    for (int channel = 0; channel < 3; ++channel) {
        for (std::size_t k = 0; k < relief.blocks.size(); ++k) {
            const Plane values = read_plane(reader);
            for (std::size_t corner = 0; corner < corners; ++corner) {
                relief.colours[k * corners + corner][channel] = values.at(corner);
            }
        }
    }
    relief.covers = reader.read_all<std::uint64_t>(header.covers);
    return relief;
}

} // namespace frustumscreen::pack
