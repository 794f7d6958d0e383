/// A level, or a relief that the GPU draws, on its way to the GPU's memory, in pieces, so that no frame waits
/// for a whole artifact.
///
/// Main memory  a mip level is freed once it is uploaded.
/// Threads  the render thread, with the display's context current, including destruction.
/// Errors   the driver is out of memory, or the texture exceeds its limit.
#pragma once

#include "app/render/block_upload.h"
#include "app/scene/level_data.h"
#include "firmware_host/base/result.h"
#include "firmware_host/gl/gl_handle.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace frustumscreen::render {

class LevelUpload {
public:
    explicit LevelUpload(scene::LevelData data) : data_(std::move(data)) {}

    /// Uploads `max_bytes` more, or the rest; a row of texels is uploaded whole, so it may exceed them
    /// slightly.
    [[nodiscard]] Result<void> go_on(std::uint64_t max_bytes = std::numeric_limits<std::uint64_t>::max());
    /// True once everything is uploaded.
    [[nodiscard]] bool done() const { return done_; }

private:
    friend class GpuStore;
    [[nodiscard]] Result<void> begin();
    [[nodiscard]] Result<void> begin_texture();
    void begin_vertices();
    [[nodiscard]] std::uint64_t upload_vertices(std::uint64_t max_bytes);
    [[nodiscard]] std::uint64_t upload_texels(std::uint64_t max_bytes);

    scene::LevelData data_;
    std::optional<BlockUpload> blocks_; ///< for a relief that the GPU draws
    gl::GlVertexArray vertex_array_;
    gl::GlBuffer vertices_;
    gl::GlTexture texels_;
    bool begun_ = false;
    bool done_ = false;
    std::size_t vertices_there_ = 0;
    std::size_t mip_ = 0; ///< the next one of `data_.mips`
    int row_ = 0;         ///< the next row of that mip level
};

} // namespace frustumscreen::render
