#include "app/bench/techniques/peer_mesh.h"

#include "app/bench/techniques/closed_mesh.h"

#include <glm/gtc/type_ptr.hpp>

#include <limits>
#include <span>

namespace frustumscreen {

namespace {

constexpr std::string_view vertex_source = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 colour;
uniform mat4 clip_from_prop;
out vec2 at_uv;
out vec4 at_colour;
out vec3 at_point;
void main() {
    at_uv = uv;
    at_colour = colour;
    at_point = position;
    gl_Position = clip_from_prop * vec4(position, 1.0);
})";

constexpr std::string_view fragment_source = R"(
in vec2 at_uv;
in vec4 at_colour;
in vec3 at_point;
uniform sampler2D base;
uniform vec4 base_colour;
uniform float cutoff;
out vec4 result;
void main() {
#if !defined(POINT) || defined(MASKED)
    vec4 colour = texture(base, at_uv) * base_colour * at_colour;
#endif
#ifdef MASKED
    if (colour.a < cutoff) discard;
#endif
#ifdef POINT
    result = vec4(at_point, 1.0);
#else
    result = vec4(colour.rgb, 1.0);
#endif
})";

GlBuffer make_buffer(GLenum target, std::span<const std::byte> bytes) {
    GlBuffer buffer = GlBuffer::generate();
    glBindBuffer(target, buffer.get());
    glBufferData(target, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), GL_STATIC_DRAW);
    return buffer;
}

GLint gl_wrap(Wrap wrap) {
    return wrap == Wrap::Clamp ? GL_CLAMP_TO_EDGE : wrap == Wrap::Mirror ? GL_MIRRORED_REPEAT : GL_REPEAT;
}

GlTexture upload_texture(const Image8& image, Wrap wrap_u, Wrap wrap_v) {
    GlTexture texture = GlTexture::generate();
    glBindTexture(GL_TEXTURE_2D, texture.get());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 image.texels.data());
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, gl_wrap(wrap_u));
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, gl_wrap(wrap_v));
    return texture;
}

} // namespace

Result<std::shared_ptr<const PeerMesh>>
PeerMesh::upload(const SourceMesh& mesh, const glm::dmat4& prop_from_artifact, bool from_outside) {
    std::shared_ptr<PeerMesh> peer(new PeerMesh());
    for (std::size_t masked = 0; masked < 2; ++masked) {
        Result<OutputPrograms> programs =
            make_programs(masked == 1 ? "#define MASKED\n" : "", vertex_source, fragment_source);
        if (!programs) {
            return tl::unexpected<Error>(programs.error());
        }
        peer->programs_[masked] = std::move(*programs);
    }
    peer->array_ = GlVertexArray::generate();
    glBindVertexArray(peer->array_.get());
    peer->closed_ = is_closed(mesh);
    const std::vector<glm::vec3> positions_m = peer->upload_vertices(mesh, prop_from_artifact);
    peer->upload_parts(mesh, positions_m);
    glBindVertexArray(0);
    const Image8 white(1, 1, glm::u8vec4(255));
    peer->textures_.push_back(upload_texture(white, Wrap::Repeat, Wrap::Repeat));
    for (const SourceTexture& texture : mesh.textures) {
        const bool usable = texture.image && texture.image->width > 0 && texture.image->height > 0;
        peer->textures_.push_back(
            upload_texture(usable ? *texture.image : white, texture.wrap_u, texture.wrap_v));
    }
    if (glGetError() != GL_NO_ERROR) {
        return fail(ErrorKind::Internal, "the driver cannot hold the source mesh with its textures");
    }
    peer->closed_ =
        peer->closed_ || from_outside; // the driver leaves out backs; planes stay as they were found
    return peer;
}

std::vector<glm::vec3> PeerMesh::upload_vertices(const SourceMesh& mesh,
                                                 const glm::dmat4& prop_from_artifact) {
    const auto attribute = [this](GLuint index, GLint components, std::span<const std::byte> bytes) {
        buffers_.push_back(make_buffer(GL_ARRAY_BUFFER, bytes));
        glEnableVertexAttribArray(index);
        glVertexAttribPointer(index, components, GL_FLOAT, GL_FALSE, 0, nullptr);
    };
    std::vector<glm::vec3> positions;
    positions.reserve(mesh.positions.size());
    box_ = {glm::dvec3(std::numeric_limits<double>::infinity()),
            glm::dvec3(-std::numeric_limits<double>::infinity())};
    for (const glm::dvec3& position : mesh.positions) {
        const glm::dvec3 placed(prop_from_artifact * glm::dvec4(position, 1.0));
        box_ = {glm::min(box_.low, placed), glm::max(box_.high, placed)};
        positions.emplace_back(placed);
    }
    attribute(0, 3, std::as_bytes(std::span(positions)));
    if (!mesh.uvs.empty()) {
        attribute(1, 2, std::as_bytes(std::span(mesh.uvs)));
    }
    if (!mesh.colours.empty()) {
        attribute(2, 4, std::as_bytes(std::span(mesh.colours)));
    }
    return positions;
}

void PeerMesh::upload_parts(const SourceMesh& mesh, std::span<const glm::vec3> positions_m) {
    std::vector<std::size_t> next(mesh.materials.size() + 1, 0); // counting sort by material
    for (const std::uint32_t material : mesh.triangle_materials) {
        next[material + 1] += 3;
    }
    for (std::size_t k = 0; k < mesh.materials.size(); ++k) {
        const SourceMaterial& material = mesh.materials[k];
        const std::size_t count = next[k + 1];
        next[k + 1] += next[k];
        if (count > 0) {
            const bool textured = material.texture >= 0 && !mesh.uvs.empty();
            parts_.push_back({material.base_colour,
                              textured ? static_cast<std::size_t>(material.texture) + 1 : 0,
                              material.alpha_mask ? material.alpha_cutoff : -1.0F,
                              {static_cast<std::uint32_t>(next[k]), static_cast<std::uint32_t>(count)}});
        }
    }
    std::vector<std::uint32_t> indices(3 * mesh.triangles.size());
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
        std::size_t& at = next[mesh.triangle_materials[k]];
        for (const std::uint32_t corner : mesh.triangles[k]) {
            indices[at++] = corner;
        }
    }
    std::vector<std::span<std::uint32_t>> parts;
    for (const Part& part : parts_) {
        parts.push_back(std::span(indices).subspan(part.all.first, part.all.count));
    }
    triangles_ = peer_triangles(positions_m, box_, parts, closed_);
    indices_ = make_buffer(GL_ELEMENT_ARRAY_BUFFER, std::as_bytes(std::span(indices)));
}

void PeerMesh::begin(GLenum front) const {
    glFrontFace(front);
    glCullFace(GL_BACK);
    (closed_ ? glEnable : glDisable)(GL_CULL_FACE);
    glBindVertexArray(array_.get());
    glVertexAttrib4f(2, 1.0F, 1.0F, 1.0F, 1.0F); // where there are no vertex colours
    glActiveTexture(GL_TEXTURE0);
}

namespace {
void end_mesh() {
    glBindVertexArray(0);
    glDisable(GL_CULL_FACE);
    glFrontFace(GL_CCW);
}
} // namespace

void PeerMesh::draw(const glm::dmat4& clip_from_prop, Output output, GLenum front) const {
    begin(front);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.get());
    for (const Part& part : parts_) {
        draw_part(part, part.all, glm::mat4(clip_from_prop), output);
    }
    end_mesh();
}

void PeerMesh::draw(const glm::dmat4& clip_from_prop, Output output, GLenum front,
                    const VisibleParts& visible, std::size_t face) const {
    begin(front);
    visible.bind();
    for (std::size_t k = 0; k < parts_.size(); ++k) {
        draw_part(parts_[k], visible.range(face, k), glm::mat4(clip_from_prop), output);
    }
    end_mesh();
}

void PeerMesh::draw_part(const Part& part, const IndexRange& range, const glm::mat4& clip,
                         Output output) const {
    if (range.count == 0) {
        return;
    }
    const GLuint program = programs_[part.cutoff >= 0.0F ? 1 : 0][static_cast<std::size_t>(output)].get();
    glUseProgram(program);
    glUniformMatrix4fv(glGetUniformLocation(program, "clip_from_prop"), 1, GL_FALSE, glm::value_ptr(clip));
    glUniform4fv(glGetUniformLocation(program, "base_colour"), 1, glm::value_ptr(part.base_colour));
    glUniform1f(glGetUniformLocation(program, "cutoff"), part.cutoff);
    glBindTexture(GL_TEXTURE_2D, textures_[part.texture].get());
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(range.count), GL_UNSIGNED_INT,
                   // OpenGL ES takes an offset as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
                   reinterpret_cast<const void*>(std::uintptr_t{range.first} * sizeof(std::uint32_t)));
}

} // namespace frustumscreen
