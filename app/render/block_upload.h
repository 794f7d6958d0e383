/// A relief's blocks on their way to the GPU's memory, in pieces, as block_shader.h reads them: three
/// textures, in which block k is at column k % columns and row k / columns.
///
/// colours  9 x 9 texels a block, RGBA8: the sRGB codes at its corners, and in alpha the code of the corner's
///          residual.
/// numbers  3 x 1 texels a block, RGBA32UI: u0, v0, w0, w_u; w_v, residual_low, residual_step, first_cover;
///          mask, cut. All but the last five words are the bits of 32-bit floats (block_relief.h).
/// covers   one texel per cut cell, RG32UI, row by row: the lower and the upper half of its bits.
///
/// Threads  the render thread, with the display's context current, including destruction.
/// Errors   the driver is out of memory, or does not allow textures of this size.
#pragma once

#include "app/relief/block_relief.h"
#include "firmware_host/base/result.h"
#include "firmware_host/gl/gl_handle.h"

#include <cstdint>
#include <memory>
#include <span>
#include <utility>

namespace frustumscreen::render {

/// The layout of blocks, and of covers, in their textures.
struct BlockSheet {
    int columns = 1, rows = 1;
    int cover_columns = 1, cover_rows = 1;
};
/// `max_texels`: the driver's limit for a texture's side.
[[nodiscard]] Result<BlockSheet> sheet_of(const relief::BlockRelief& relief, int max_texels);

/// The largest number of blocks that fits the driver's textures.
[[nodiscard]] std::uint32_t max_blocks_on_gpu();

/// GPU memory of a relief, bytes.
[[nodiscard]] std::uint64_t gpu_bytes(const relief::BlockRelief& relief);

/// Other colours of the same blocks at once, laid out as `colours` above, with their own alpha. `colours`: in the order of the relief's.
[[nodiscard]] gl::GlTexture upload_block_colours(const relief::BlockRelief& relief,
                                                 std::span<const glm::u8vec4> colours);

class BlockUpload {
public:
    explicit BlockUpload(std::shared_ptr<const relief::BlockRelief> relief) : relief_(std::move(relief)) {}

    /// Uploads `max_bytes` more, or the rest; a row of blocks is uploaded whole, so it may exceed them
    /// slightly.
    [[nodiscard]] Result<void> go_on(std::uint64_t max_bytes);
    [[nodiscard]] bool done() const { return begun_ && row_ == sheet_.rows; }

    struct Textures {
        gl::GlTexture colours, numbers, covers;
    };
    /// Only once `done` is true.
    [[nodiscard]] Textures take() { return std::move(textures_); }

private:
    [[nodiscard]] Result<void> begin();
    void upload_row();
    void upload_covers();

    std::shared_ptr<const relief::BlockRelief> relief_;
    Textures textures_;
    BlockSheet sheet_;
    int row_ = 0; ///< the next row of blocks
    bool begun_ = false;
};

} // namespace frustumscreen::render
