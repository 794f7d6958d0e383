#include "app/render/artifact_gpu.h"

#include <GLES2/gl2ext.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>

namespace frustumscreen {

namespace {

/// Coarser levels mix charts that lie side by side in the atlas.
constexpr int coarsest_mip_level = 4;

/// The edge of the surface's mean texel, inverted: texels along one box unit.
double texels_per_box(const PackLevel& level, const Image8& texture, const glm::dvec3& box_size) {
    const auto position = [&](std::uint32_t vertex) {
        const auto& q = level.vertices[vertex].position;
        return glm::dvec3(q[0], q[1], q[2]) * box_size;
    };
    const auto texel = [&](std::uint32_t vertex) {
        const auto& q = level.vertices[vertex].uv;
        return glm::dvec3(q[0] * texture.width, q[1] * texture.height, 0);
    };
    const auto doubled_area = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        return glm::length(glm::cross(b - a, c - a));
    };
    double texels = 0.0;
    double surface = 0.0;
    for (std::size_t k = 0; k + 2 < level.indices.size(); k += 3) {
        const std::array<std::uint32_t, 3> v{level.indices[k], level.indices[k + 1], level.indices[k + 2]};
        texels += doubled_area(texel(v[0]), texel(v[1]), texel(v[2]));
        surface += doubled_area(position(v[0]), position(v[1]), position(v[2]));
    }
    return surface > 0.0 ? std::sqrt(texels / surface) : 0.0;
}

GlTexture upload_colour(const Image8& image) {
    GlTexture texture = GlTexture::generate();
    const auto longest = static_cast<unsigned>(std::max(image.width, image.height));
    const int levels = std::min(static_cast<int>(std::bit_width(longest)), coarsest_mip_level + 1);
    glBindTexture(GL_TEXTURE_2D, texture.get());
    glTexStorage2D(GL_TEXTURE_2D, levels, GL_SRGB8_ALPHA8, image.width, image.height);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE,
                    image.texels.data());
    glGenerateMipmap(GL_TEXTURE_2D);
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
    artifact.texels_per_box_ = texels_per_box(source, image, pack.box_size);
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
    artifact.texture_ = upload_colour(image);
    if (glGetError() != GL_NO_ERROR) {
        return fail(ErrorKind::BadConfiguration,
                    "render: the driver has no memory for the artifact; bake a smaller one");
    }
    return artifact;
}

float ArtifactGpu::mip_level(double samples_per_box) const {
    const double texels_per_sample = texels_per_box_ / samples_per_box;
    // The filter rounds: half a level more, and it takes the first level that no sample skips a texel of.
    return texels_per_sample > 0.0 ? static_cast<float>(std::log2(texels_per_sample) + 0.5) : 0.0F;
}

} // namespace frustumscreen
