#include "app/render/artifact_gpu.h"

#include "app/render/gl_memory.h"

#include <GLES2/gl2ext.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstddef>

namespace frustumscreen {

namespace {

GlTexture upload_colour(const Image8& image, int finest_mip) {
    const Image8* mip = &image;
    Image8 made;
    const auto go_on = [&] {
        made = half_size(*mip);
        mip = &made;
    };
    for (int k = 0; k < finest_mip; ++k) {
        go_on();
    }
    GlTexture texture = GlTexture::generate();
    const auto longest = static_cast<unsigned>(std::max(mip->width, mip->height));
    const int levels =
        std::min(static_cast<int>(std::bit_width(longest)), coarsest_mip_level + 1 - finest_mip);
    glBindTexture(GL_TEXTURE_2D, texture.get());
    glTexStorage2D(GL_TEXTURE_2D, levels, GL_SRGB8_ALPHA8, mip->width, mip->height);
    for (int k = 0; k < levels; ++k) {
        if (k > 0) {
            go_on();
        }
        glTexSubImage2D(GL_TEXTURE_2D, k, 0, 0, mip->width, mip->height, GL_RGBA, GL_UNSIGNED_BYTE,
                        mip->texels.data());
    }
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SRGB_DECODE_EXT, GL_SKIP_DECODE_EXT);
    return texture;
}

template <typename T> GlBuffer upload_buffer(GLenum target, const std::vector<T>& data) {
    GlBuffer buffer = GlBuffer::generate();
    glBindBuffer(target, buffer.get());
    glBufferData(target, static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(), GL_STATIC_DRAW);
    return buffer;
}

} // namespace

Result<ArtifactGpu> ArtifactGpu::upload(const Pack& pack, std::uint32_t level) {
    return upload(whole_level(pack, level), pack.textures[pack.levels[level].texture]);
}

Result<ArtifactGpu> ArtifactGpu::upload(const SceneLevel& level, const Image8& image) {
    const PackLevel& source = level.mesh;
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (std::max(image.width, image.height) > limit) {
        return fail(
            ErrorKind::BadConfiguration,
            fmt::format(
                "render: a texture of {} x {} texels; this driver allows {}: bake with a smaller --size",
                image.width, image.height, limit));
    }
    ArtifactGpu artifact;
    artifact.texels_per_box_ = level.texels_per_box;
    artifact.finest_mip_ = level.finest_mip;
    artifact.cut_out_ = has_cut_texels(image);
    artifact.vertex_array_ = GlVertexArray::generate();
    glBindVertexArray(artifact.vertex_array_.get());
    artifact.vertices_ = upload_buffer(GL_ARRAY_BUFFER, source.vertices);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 3, GL_UNSIGNED_SHORT, GL_TRUE, sizeof(PackVertex), nullptr);
    glEnableVertexAttribArray(1);
    glVertexAttribPointer(1, 2, GL_UNSIGNED_SHORT, GL_TRUE, sizeof(PackVertex),
                          // OpenGL ES takes an offset as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
                          reinterpret_cast<const void*>(offsetof(PackVertex, uv)));
    glBindVertexArray(0);
    artifact.texture_ = upload_colour(image, level.finest_mip);
    if (glGetError() != GL_NO_ERROR) {
        return fail(ErrorKind::BadConfiguration,
                    "render: the driver has no memory for the artifact; bake a smaller one");
    }
    return artifact;
}

float ArtifactGpu::mip_level(double samples_per_box) const {
    return static_cast<float>(frustumscreen::mip_level(texels_per_box_, samples_per_box) - finest_mip_);
}

std::uint64_t ArtifactGpu::bytes() const {
    return bytes_of_buffer(vertices_) + bytes_of_texture(texture_);
}

} // namespace frustumscreen
