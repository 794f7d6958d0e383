#include "app/render/block_upload.h"

#include "app/image/image.h"

#include <fmt/format.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace frustumscreen::render {

namespace {

constexpr int numbers_of_block = 3; ///< texels
constexpr std::size_t corners = std::size_t{relief::block_corners} * relief::block_corners;
constexpr std::size_t cells = std::size_t{relief::block_cells} * relief::block_cells;
constexpr std::uint64_t bytes_of_block =
    corners * sizeof(glm::u8vec4) + numbers_of_block * sizeof(glm::uvec4);

/// Side of the smallest square with space for `count` elements; at least 1.
int side_of(std::size_t count) {
    return std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count)))));
}

int rows_of(std::size_t count, int columns) {
    const auto along = static_cast<std::size_t>(columns);
    return std::max(1, static_cast<int>((count + along - 1) / along));
}

std::uint32_t lower(std::uint64_t bits) {
    return static_cast<std::uint32_t>(bits);
}

std::uint32_t upper(std::uint64_t bits) {
    return static_cast<std::uint32_t>(bits >> 32U);
}

std::array<glm::uvec4, numbers_of_block> numbers_of(const relief::ReliefBlock& block) {
    const auto bits = [](float number) { return std::bit_cast<std::uint32_t>(number); };
    return {
        glm::uvec4(bits(block.u0), bits(block.v0), bits(block.w0), bits(block.w_u)),
        glm::uvec4(bits(block.w_v), bits(block.residual_low), bits(block.residual_step), block.first_cover),
        glm::uvec4(lower(block.mask), upper(block.mask), lower(block.cut), upper(block.cut))};
}

/// Residual code of a block's corner. Neighbouring cells share corners; the corners of the last column and
/// row come from the last cells.
std::uint8_t residual_code(const relief::BlockRelief& relief, std::size_t block, std::size_t column,
                           std::size_t row) {
    const std::size_t x = std::min(column, std::size_t{relief::block_cells} - 1);
    const std::size_t y = std::min(row, std::size_t{relief::block_cells} - 1);
    const std::uint32_t codes = relief.corner_codes[block * cells + y * relief::block_cells + x];
    return static_cast<std::uint8_t>(codes >> 8U * (column - x + 2 * (row - y)));
}

/// The driver's limit for a texture's side.
int max_texels() {
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    return limit;
}

gl::GlTexture make_texture(GLenum format, int width, int height, GLint filter) {
    gl::GlTexture texture = gl::GlTexture::generate();
    glBindTexture(GL_TEXTURE_2D, texture.get());
    glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

} // namespace

Result<BlockSheet> sheet_of(const relief::BlockRelief& relief, int max_texels) {
    BlockSheet sheet;
    sheet.columns = side_of(relief.blocks.size());
    sheet.rows = rows_of(relief.blocks.size(), sheet.columns);
    sheet.cover_columns = side_of(relief.covers.size());
    sheet.cover_rows = rows_of(relief.covers.size(), sheet.cover_columns);
    if (const int widest = std::max(relief::block_corners * sheet.columns, sheet.cover_columns);
        widest > max_texels) {
        return fail(ErrorKind::BadConfiguration, "render.relief_too_wide",
                    "render: a relief of {} blocks needs textures of {} texels a side; this driver allows "
                    "{}: take a coarser relief, or a technique without -gpu",
                    relief.blocks.size(), widest, max_texels);
    }
    return sheet;
}

std::uint64_t gpu_bytes(const relief::BlockRelief& relief) {
    const BlockSheet sheet = sheet_of(relief, std::numeric_limits<int>::max()).value();
    const auto texels = [](int width, int height) {
        return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    };
    return texels(sheet.columns, sheet.rows) * bytes_of_block +
           texels(sheet.cover_columns, sheet.cover_rows) * sizeof(glm::uvec2);
}

/// A block has at most 64 covers, so the covers' texture is never the wider one.
std::uint32_t max_blocks_on_gpu() {
    const auto along = static_cast<std::uint32_t>(max_texels() / relief::block_corners);
    return along * along;
}

gl::GlTexture upload_block_colours(const relief::BlockRelief& relief, std::span<const glm::u8vec4> colours) {
    const int columns = side_of(relief.blocks.size());
    const int wide = relief::block_corners * columns;
    image::Image8 sheet(wide, relief::block_corners * rows_of(relief.blocks.size(), columns));
    for (std::size_t k = 0; k < colours.size(); ++k) {
        const auto block = static_cast<int>(k / corners);
        const auto corner = static_cast<int>(k % corners);
        sheet.at(block % columns * relief::block_corners + corner % relief::block_corners,
                 block / columns * relief::block_corners + corner / relief::block_corners) = colours[k];
    }
    gl::GlTexture texture = make_texture(GL_RGBA8, sheet.width, sheet.height, GL_LINEAR);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, sheet.width, sheet.height, GL_RGBA, GL_UNSIGNED_BYTE,
                    sheet.texels.data());
    return texture;
}

/// Allocates the textures and uploads the covers, which are a small part of the data.
Result<void> BlockUpload::begin() {
    TRY(sheet_, sheet_of(*relief_, max_texels()));
    textures_.colours = make_texture(GL_RGBA8, relief::block_corners * sheet_.columns,
                                     relief::block_corners * sheet_.rows, GL_LINEAR);
    textures_.numbers = make_texture(GL_RGBA32UI, numbers_of_block * sheet_.columns, sheet_.rows, GL_NEAREST);
    textures_.covers = make_texture(GL_RG32UI, sheet_.cover_columns, sheet_.cover_rows, GL_NEAREST);
    upload_covers();
    return {};
}

void BlockUpload::upload_covers() {
    const std::vector<std::uint64_t>& covers = relief_->covers;
    const auto wide = static_cast<std::size_t>(sheet_.cover_columns);
    std::vector<glm::uvec2> row;
    for (std::size_t first = 0; first < covers.size(); first += wide) {
        row.clear();
        for (std::size_t k = first; k < std::min(first + wide, covers.size()); ++k) {
            row.emplace_back(lower(covers[k]), upper(covers[k]));
        }
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, static_cast<GLint>(first / wide),
                        static_cast<GLsizei>(row.size()), 1, GL_RG_INTEGER, GL_UNSIGNED_INT, row.data());
    }
}

void BlockUpload::upload_row() {
    const auto columns = static_cast<std::size_t>(sheet_.columns);
    const std::size_t first = static_cast<std::size_t>(row_) * columns;
    const std::size_t end = std::min(first + columns, relief_->blocks.size());
    const std::size_t wide = (end - first) * relief::block_corners;
    std::vector<glm::uvec4> numbers;
    std::vector<glm::u8vec4> colours(wide * relief::block_corners);
    for (std::size_t block = first; block < end; ++block) {
        const std::array<glm::uvec4, numbers_of_block> of = numbers_of(relief_->blocks[block]);
        numbers.insert(numbers.end(), of.begin(), of.end());
        for (std::size_t corner = 0; corner < corners; ++corner) {
            const std::size_t column = corner % relief::block_corners;
            const std::size_t row = corner / relief::block_corners;
            glm::u8vec4& texel = colours[row * wide + (block - first) * relief::block_corners + column];
            texel = relief_->colours[block * corners + corner];
            texel.a = residual_code(*relief_, block, column, row);
        }
    }
    glBindTexture(GL_TEXTURE_2D, textures_.numbers.get());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, row_, static_cast<GLsizei>(numbers.size()), 1, GL_RGBA_INTEGER,
                    GL_UNSIGNED_INT, numbers.data());
    glBindTexture(GL_TEXTURE_2D, textures_.colours.get());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, relief::block_corners * row_, static_cast<GLsizei>(wide),
                    relief::block_corners, GL_RGBA, GL_UNSIGNED_BYTE, colours.data());
    ++row_;
}

Result<void> BlockUpload::go_on(std::uint64_t max_bytes) {
    glActiveTexture(GL_TEXTURE0);
    if (!begun_) {
        TRY_VOID(begin());
        begun_ = true;
    }
    const std::uint64_t bytes_a_row = static_cast<std::uint64_t>(sheet_.columns) * bytes_of_block;
    for (std::uint64_t sent = 0; sent < max_bytes && row_ < sheet_.rows; sent += bytes_a_row) {
        upload_row();
    }
    if (glGetError() != GL_NO_ERROR) {
        return fail(ErrorKind::BadConfiguration, "render.no_room_for_relief",
                    "render: the driver has no memory for the relief; take a coarser one, or a technique "
                    "without -gpu");
    }
    return {};
}

} // namespace frustumscreen::render
