#include "app/render/artifact_gpu.h"

#include <GLES2/gl2ext.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <string_view>

namespace frustumscreen {

namespace {

/// Coarser levels mix charts that lie side by side in the atlas.
constexpr int coarsest_mip_level = 4;

bool driver_has(std::string_view extension) {
    GLint count = 0;
    glGetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint k = 0; k < count; ++k) {
        if (extension == reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(k)))) {
            return true;
        }
    }
    return false;
}

GlTexture upload_colour(const Image8& image, const TextureFilter& filter) {
    GlTexture texture = GlTexture::generate();
    const auto longest = static_cast<unsigned>(std::max(image.width, image.height));
    const int levels = std::min(static_cast<int>(std::bit_width(longest)), coarsest_mip_level + 1);
    glBindTexture(GL_TEXTURE_2D, texture.get());
    glTexStorage2D(GL_TEXTURE_2D, levels, GL_SRGB8_ALPHA8, image.width, image.height);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE,
                    image.texels.data());
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    if (filter.anisotropy > 1.0F && driver_has("GL_EXT_texture_filter_anisotropic")) {
        glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MAX_ANISOTROPY_EXT, filter.anisotropy);
    }
    return texture;
}

template <typename T> GlBuffer upload_buffer(GLenum target, const std::vector<T>& data) {
    GlBuffer buffer = GlBuffer::generate();
    glBindBuffer(target, buffer.get());
    glBufferData(target, static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(), GL_STATIC_DRAW);
    return buffer;
}

} // namespace

Result<ArtifactGpu> ArtifactGpu::upload(const Pack& pack, std::uint32_t level, const TextureFilter& filter) {
    const PackLevel& source = pack.levels[level];
    const Image8& image = pack.textures[source.texture];
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
    artifact.level_bias_ = filter.level_bias;
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
    artifact.texture_ = upload_colour(image, filter);
    if (glGetError() != GL_NO_ERROR) {
        return fail(ErrorKind::BadConfiguration,
                    "render: the driver has no memory for the artifact; bake a smaller one");
    }
    return artifact;
}

} // namespace frustumscreen
