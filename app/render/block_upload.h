/// A relief's blocks on their way into the GPU's memory, in pieces, as block_shader.h reads them: three textures, of which block k lies
/// at column k % columns and row k / columns.
///
/// colours  9 x 9 texels a block, RGBA8: the sRGB codes at its corners, and in alpha the code of the corner's residual.
/// numbers  3 x 1 texels a block, RGBA32UI: u0, v0, w0, w_u; w_v, residual_low, residual_step, first_cover; mask, cut. All but
///          the last five words are the bits of 32-bit numbers (block_relief.h).
/// covers   a texel a cut cell, RG32UI, row by row: the lower and the upper half of its bits.
///
/// Threads  the render thread, with the display's context current; also where it is destroyed.
/// Errors   the driver has no memory, or allows no textures so large.
#pragma once

#include "app/relief/block_relief.h"
#include "firmware_host/base/result.h"
#include "firmware_host/gl/gl_handle.h"

#include <cstdint>
#include <memory>
#include <utility>

namespace frustumscreen {

/// How many blocks, and covers, lie side by side and one below the other.
struct BlockSheet {
    int columns = 1, rows = 1;
    int cover_columns = 1, cover_rows = 1;
};
/// `most_texels`: along a texture's side, that the driver allows.
[[nodiscard]] Result<BlockSheet> sheet_of(const BlockRelief& relief, int most_texels);

/// Blocks of a relief that the driver's textures have room for.
[[nodiscard]] std::uint32_t most_blocks_on_gpu();

/// Bytes of GPU memory that a relief takes.
[[nodiscard]] std::uint64_t gpu_bytes(const BlockRelief& relief);

class BlockUpload {
public:
    explicit BlockUpload(std::shared_ptr<const BlockRelief> relief) : relief_(std::move(relief)) {}

    /// Uploads `most_bytes` more, or the rest; a row of blocks is never cut, so it may be a little more.
    [[nodiscard]] Result<void> go_on(std::uint64_t most_bytes);
    [[nodiscard]] bool done() const { return begun_ && row_ == sheet_.rows; }

    struct Textures {
        GlTexture colours, numbers, covers;
    };
    /// It must be done.
    [[nodiscard]] Textures take() { return std::move(textures_); }

private:
    [[nodiscard]] Result<void> begin();
    void upload_row();
    void upload_covers();

    std::shared_ptr<const BlockRelief> relief_;
    Textures textures_;
    BlockSheet sheet_;
    int row_ = 0; ///< of blocks, the next one
    bool begun_ = false;
};

} // namespace frustumscreen
