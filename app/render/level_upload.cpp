#include "app/render/level_upload.h"

#include <GLES2/gl2ext.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace frustumscreen::render {

Result<void> LevelUpload::go_on(std::uint64_t max_bytes) {
    if (data_.relief && !data_.on_gpu) {
        done_ = true; // the processor rasterizes it from main memory
        return {};
    }
    if (data_.relief) {
        if (!blocks_) {
            blocks_.emplace(data_.relief);
        }
        Result<void> sent = blocks_->go_on(max_bytes);
        done_ = sent && blocks_->done();
        return sent;
    }
    if (!begun_) {
        TRY_VOID(begin());
        begun_ = true;
    }
    std::uint64_t left = max_bytes;
    left -= std::min(left, upload_vertices(left));
    while (left > 0 && mip_ < data_.mips.size()) {
        left -= std::min(left, upload_texels(left));
    }
    done_ = vertices_there_ == data_.vertices.size() && mip_ == data_.mips.size();
    if (glGetError() != GL_NO_ERROR) {
        return fail(ErrorKind::BadConfiguration, "render.no_room_for_artifact",
                    "render: the driver has no memory for the artifact; bake a smaller one");
    }
    return {};
}

/// Creates the objects and allocates their memory, without copying data.
Result<void> LevelUpload::begin() {
    if (!data_.texture_of) {
        TRY_VOID(begin_texture());
    }
    begin_vertices();
    return {};
}

Result<void> LevelUpload::begin_texture() {
    const image::Image8& finest = data_.mips.front();
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    const int scale = 1 << data_.finest_mip;
    if (std::max(finest.width, finest.height) > limit) {
        return fail(ErrorKind::BadConfiguration, "render.texture_size",
                    "render: a texture of {} x {} texels; this driver allows {}: bake with a smaller --size",
                    finest.width * scale, finest.height * scale, limit);
    }
    texels_ = gl::GlTexture::generate();
    glBindTexture(GL_TEXTURE_2D, texels_.get());
    glTexStorage2D(GL_TEXTURE_2D, static_cast<GLsizei>(data_.mips.size()), GL_SRGB8_ALPHA8, finest.width,
                   finest.height);
    // Each draw uses one mip level, its GL_TEXTURE_BASE_LEVEL: a filter that chooses costs more.
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SRGB_DECODE_EXT, GL_SKIP_DECODE_EXT);
    return {};
}

void LevelUpload::begin_vertices() {
    vertex_array_ = gl::GlVertexArray::generate();
    vertices_ = gl::GlBuffer::generate();
    glBindVertexArray(vertex_array_.get());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.get());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(data_.vertices.size() * sizeof(pack::PackVertex)),
                 nullptr, GL_STATIC_DRAW);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 3, GL_UNSIGNED_SHORT, GL_TRUE, sizeof(pack::PackVertex), nullptr);
    glEnableVertexAttribArray(1);
    glVertexAttribPointer(1, 2, GL_UNSIGNED_SHORT, GL_TRUE, sizeof(pack::PackVertex),
                          // OpenGL ES takes an offset as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
                          reinterpret_cast<const void*>(offsetof(pack::PackVertex, uv)));
    glBindVertexArray(0);
}

std::uint64_t LevelUpload::upload_vertices(std::uint64_t max_bytes) {
    const std::size_t count = std::min<std::uint64_t>(data_.vertices.size() - vertices_there_,
                                                      max_bytes / sizeof(pack::PackVertex) + 1);
    if (count == 0) {
        return 0;
    }
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.get());
    glBufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(vertices_there_ * sizeof(pack::PackVertex)),
                    static_cast<GLsizeiptr>(count * sizeof(pack::PackVertex)),
                    data_.vertices.data() + vertices_there_);
    vertices_there_ += count;
    return count * sizeof(pack::PackVertex);
}

std::uint64_t LevelUpload::upload_texels(std::uint64_t max_bytes) {
    image::Image8& mip = data_.mips[mip_];
    const std::uint64_t bytes_a_row = sizeof(glm::u8vec4) * static_cast<std::uint64_t>(mip.width);
    const int rows = static_cast<int>(
        std::min<std::uint64_t>(static_cast<std::uint64_t>(mip.height - row_), max_bytes / bytes_a_row + 1));
    glBindTexture(GL_TEXTURE_2D, texels_.get());
    glTexSubImage2D(GL_TEXTURE_2D, static_cast<GLint>(mip_), 0, row_, mip.width, rows, GL_RGBA,
                    GL_UNSIGNED_BYTE, &mip.at(0, row_));
    row_ += rows;
    if (row_ == mip.height) {
        mip = image::Image8();
        ++mip_;
        row_ = 0;
    }
    return bytes_a_row * static_cast<std::uint64_t>(rows);
}

} // namespace frustumscreen::render
