#include "app/bench/techniques/peer_mesh.h"

#include "app/bench/techniques/closed_mesh.h"
#include "app/scene/face_view.h"
#include "app/scene/scene_level.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <string>

namespace frustumscreen::bench {

namespace {

constexpr std::string_view vertex_source = R"(
layout(location = 0) in vec3 position; // over the box
layout(location = 1) in vec2 uv;
uniform mat4 clip_from_unit;
out vec2 at_uv;
#ifdef TINTED
layout(location = 2) in vec4 colour;
out vec4 at_colour;
#endif
#ifdef POINT
uniform vec3 low;
uniform vec3 extent;
out vec3 at_point;
#endif
void main() {
    at_uv = uv;
#ifdef TINTED
    at_colour = colour;
#endif
#ifdef POINT
    at_point = low + extent * position;
#endif
    gl_Position = clip_from_unit * vec4(position, 1.0);
})";

constexpr std::string_view fragment_source = R"(
in vec2 at_uv;
uniform sampler2D base;
#ifdef TINTED
in vec4 at_colour;
#endif
#ifdef POINT
in vec3 at_point;
#endif
#ifdef MASKED
uniform float cutoff;
#endif
out vec4 result;
void main() {
#if !defined(POINT) || defined(MASKED)
    vec4 colour = texture(base, at_uv);
#ifdef TINTED
    colour *= at_colour;
#endif
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

gl::GlBuffer make_buffer(GLenum target, std::span<const std::byte> bytes) {
    gl::GlBuffer buffer = gl::GlBuffer::generate();
    glBindBuffer(target, buffer.get());
    glBufferData(target, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), GL_STATIC_DRAW);
    return buffer;
}

GLint gl_wrap(bake::Wrap wrap) {
    return wrap == bake::Wrap::Clamp    ? GL_CLAMP_TO_EDGE
           : wrap == bake::Wrap::Mirror ? GL_MIRRORED_REPEAT
                                        : GL_REPEAT;
}

/// The texture holds codes; coarser levels are averaged in linear light. Each draw uses one level, its
/// GL_TEXTURE_BASE_LEVEL, like the exhibit's. A source without a texture is filtered too, because on the
/// kiosk any technique's texture holds the baked light.
gl::GlTexture upload_texture(const image::Image8& finest, bake::Wrap wrap_u, bake::Wrap wrap_v) {
    gl::GlTexture texture = gl::GlTexture::generate();
    glBindTexture(GL_TEXTURE_2D, texture.get());
    image::Image8 image = finest;
    for (GLint level = 0;; ++level) {
        glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                     image.texels.data());
        if (image.width == 1 && image.height == 1) {
            break;
        }
        image = image::half_size(image);
    }
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, gl_wrap(wrap_u));
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, gl_wrap(wrap_v));
    return texture;
}

glm::u8vec4 code_of(const glm::vec4& linear) {
    const glm::vec4 in = glm::clamp(linear, 0.0F, 1.0F);
    return {image::srgb8_from_linear(in.r), image::srgb8_from_linear(in.g), image::srgb8_from_linear(in.b),
            static_cast<std::uint8_t>(std::lround(in.a * 255.0F))};
}

/// A texture multiplied by the material's colour.
image::Image8 coloured(const image::Image8& image, const glm::vec4& base_colour) {
    if (base_colour == glm::vec4(1.0F)) {
        return image;
    }
    const std::array<float, 256>& linear = image::linear_from_srgb8();
    image::Image8 made = image;
    for (glm::u8vec4& texel : made.texels) {
        texel = code_of(base_colour * glm::vec4(linear[texel.r], linear[texel.g], linear[texel.b],
                                                static_cast<float>(texel.a) / 255.0F));
    }
    return made;
}

} // namespace

PeerMesh::Program::Program(gl::GlProgram made)
    : program(std::move(made)), clip_from_unit(glGetUniformLocation(program.get(), "clip_from_unit")),
      cutoff(glGetUniformLocation(program.get(), "cutoff")), low(glGetUniformLocation(program.get(), "low")),
      extent(glGetUniformLocation(program.get(), "extent")) {}

Result<std::shared_ptr<const PeerMesh>>
PeerMesh::upload(const bake::SourceMesh& mesh, const glm::dmat4& prop_from_artifact, bool from_outside) {
    std::shared_ptr<PeerMesh> peer(new PeerMesh());
    const std::string tinted = mesh.colours.empty() ? "" : "#define TINTED\n";
    for (std::size_t masked = 0; masked < 2; ++masked) {
        TRY(OutputPrograms programs,
            make_programs(tinted + (masked == 1 ? "#define MASKED\n" : ""), vertex_source, fragment_source));
        for (std::size_t output = 0; output < programs.size(); ++output) {
            peer->programs_[masked][output] = Program(std::move(programs[output]));
        }
    }
    peer->array_ = gl::GlVertexArray::generate();
    glBindVertexArray(peer->array_.get());
    peer->closed_ = is_closed(mesh);
    const std::vector<glm::vec3> positions_m = peer->upload_vertices(mesh, prop_from_artifact);
    peer->upload_parts(mesh, positions_m);
    glBindVertexArray(0);
    if (glGetError() != GL_NO_ERROR) {
        return fail(ErrorKind::Internal, "bench.no_room_for_mesh",
                    "the driver cannot hold the source mesh with its textures");
    }
    peer->closed_ = peer->closed_ || from_outside; // the driver culls back faces; the planes stay unchanged
    return peer;
}

std::vector<glm::vec3> PeerMesh::upload_vertices(const bake::SourceMesh& mesh,
                                                 const glm::dmat4& prop_from_artifact) {
    constexpr double max_code = 65535.0;
    std::vector<glm::dvec3> placed;
    placed.reserve(mesh.positions.size());
    box_ = {glm::dvec3(std::numeric_limits<double>::infinity()),
            glm::dvec3(-std::numeric_limits<double>::infinity())};
    for (const glm::dvec3& position : mesh.positions) {
        placed.emplace_back(prop_from_artifact * glm::dvec4(position, 1.0));
        box_ = {glm::min(box_.low, placed.back()), glm::max(box_.high, placed.back())};
    }
    const glm::dvec3 extent = glm::max(box_.high - box_.low, glm::dvec3(1e-12));
    std::vector<std::array<std::uint16_t, 4>> codes; // 8 bytes, aligned
    std::vector<glm::vec3> positions;
    for (const glm::dvec3& position : placed) {
        const glm::dvec3 code = glm::round((position - box_.low) / extent * max_code);
        codes.push_back({static_cast<std::uint16_t>(code.x), static_cast<std::uint16_t>(code.y),
                         static_cast<std::uint16_t>(code.z), 0});
        positions.emplace_back(box_.low + code / max_code * extent);
    }
    const auto attribute = [this](GLuint index, GLint components, GLenum type, GLboolean over_one,
                                  std::size_t stride, std::span<const std::byte> bytes) {
        buffers_.push_back(make_buffer(GL_ARRAY_BUFFER, bytes));
        glEnableVertexAttribArray(index);
        glVertexAttribPointer(index, components, type, over_one, static_cast<GLsizei>(stride), nullptr);
    };
    attribute(0, 3, GL_UNSIGNED_SHORT, GL_TRUE, sizeof(codes[0]), std::as_bytes(std::span(codes)));
    if (!mesh.uvs.empty()) {
        attribute(1, 2, GL_FLOAT, GL_FALSE, 0, std::as_bytes(std::span(mesh.uvs)));
    }
    if (!mesh.colours.empty()) {
        std::vector<glm::u8vec4> tints;
        std::transform(mesh.colours.begin(), mesh.colours.end(), std::back_inserter(tints), code_of);
        attribute(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, 0, std::as_bytes(std::span(tints)));
    }
    return positions;
}

namespace {

/// Mean number of texels per metre of the triangles' surface.
double texels_per_m(const bake::SourceMesh& mesh, std::span<const glm::vec3> positions_m,
                    std::span<const std::uint32_t> indices, const image::Image8& image) {
    double texels = 0.0;
    double area_m2 = 0.0;
    for (std::size_t k = 0; k + 2 < indices.size(); k += 3) {
        const auto edge = [&](std::size_t corner) {
            return glm::dvec3(positions_m[indices[k + corner]] - positions_m[indices[k]]);
        };
        const auto uv_edge = [&](std::size_t corner) {
            return glm::dvec2(mesh.uvs[indices[k + corner]] - mesh.uvs[indices[k]]) *
                   glm::dvec2(image.width, image.height);
        };
        area_m2 += glm::length(glm::cross(edge(1), edge(2)));
        texels += std::abs(uv_edge(1).x * uv_edge(2).y - uv_edge(1).y * uv_edge(2).x);
    }
    return area_m2 > 0.0 ? std::sqrt(texels / area_m2) : 0.0;
}

} // namespace

void PeerMesh::upload_parts(const bake::SourceMesh& mesh, std::span<const glm::vec3> positions_m) {
    const image::Image8 white(1, 1, glm::u8vec4(255));
    std::vector<std::vector<std::uint32_t>> by_material(mesh.materials.size());
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
        std::vector<std::uint32_t>& of = by_material[mesh.triangle_materials[k]];
        of.insert(of.end(), mesh.triangles[k].begin(), mesh.triangles[k].end());
    }
    std::vector<std::uint32_t> indices;
    for (std::size_t k = 0; k < mesh.materials.size(); ++k) {
        if (by_material[k].empty()) {
            continue;
        }
        const bake::SourceMaterial& material = mesh.materials[k];
        const bool named = material.texture >= 0 && !mesh.uvs.empty();
        const bake::SourceTexture none{};
        const bake::SourceTexture& texture =
            named ? mesh.textures[static_cast<std::size_t>(material.texture)] : none;
        const bool usable = texture.image && texture.image->width > 0 && texture.image->height > 0;
        const image::Image8& image = usable ? *texture.image : white;
        parts_.push_back(
            {.texture = textures_.size(),
             .texels_per_m = usable ? texels_per_m(mesh, positions_m, by_material[k], image) : 0.0,
             .cutoff = material.alpha_mask ? material.alpha_cutoff : -1.0F,
             .all = {static_cast<std::uint32_t>(indices.size()),
                     static_cast<std::uint32_t>(by_material[k].size())}});
        textures_.push_back(
            upload_texture(coloured(image, material.base_colour), texture.wrap_u, texture.wrap_v));
        indices.insert(indices.end(), by_material[k].begin(), by_material[k].end());
    }
    std::vector<std::span<std::uint32_t>> parts;
    for (const Part& part : parts_) {
        parts.push_back(std::span(indices).subspan(part.all.first, part.all.count));
    }
    triangles_ = peer_triangles(positions_m, box_, parts, closed_);
    glBindVertexArray(array_.get());
    indices_ = make_buffer(GL_ELEMENT_ARRAY_BUFFER, std::as_bytes(std::span(indices)));
}

void PeerMesh::begin(GLenum front) const {
    glFrontFace(front);
    glCullFace(GL_BACK);
    (closed_ ? glEnable : glDisable)(GL_CULL_FACE);
    glBindVertexArray(array_.get());
    glActiveTexture(GL_TEXTURE0);
}

namespace {
void end_mesh() {
    glBindVertexArray(0);
    glDisable(GL_CULL_FACE);
    glFrontFace(GL_CCW);
}
} // namespace

void PeerMesh::draw(const PeerPass& pass) const {
    begin(pass.front);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.get());
    for (const Part& part : parts_) {
        draw_part(part, part.all, pass);
    }
    end_mesh();
}

void PeerMesh::draw(const PeerPass& pass, const VisibleParts& visible, std::size_t face) const {
    begin(pass.front);
    visible.bind();
    for (std::size_t k = 0; k < parts_.size(); ++k) {
        draw_part(parts_[k], visible.range(face, k), pass);
    }
    end_mesh();
}

void PeerMesh::draw_part(const Part& part, const scene::IndexRange& range, const PeerPass& pass) const {
    if (range.count == 0) {
        return;
    }
    const glm::dvec3 extent = box_.high - box_.low;
    const glm::mat4 clip(pass.clip_from_prop * glm::translate(glm::dmat4(1.0), box_.low) *
                         glm::scale(glm::dmat4(1.0), extent));
    geometry::Pinhole picture;
    picture.width = pass.size.x;
    picture.height = pass.size.y;
    const double pixels_per_m =
        scene::pixels_per_unit(pass.clip_from_prop, 0.5 * (box_.low + box_.high), picture);
    const Program& program = programs_[part.cutoff >= 0.0F ? 1 : 0][static_cast<std::size_t>(pass.output)];
    glUseProgram(program.program.get());
    glUniformMatrix4fv(program.clip_from_unit, 1, GL_FALSE, glm::value_ptr(clip));
    glUniform1f(program.cutoff, part.cutoff);
    glUniform3fv(program.low, 1, glm::value_ptr(glm::vec3(box_.low)));
    glUniform3fv(program.extent, 1, glm::value_ptr(glm::vec3(extent)));
    glBindTexture(GL_TEXTURE_2D, textures_[part.texture].get());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, scene::mip_level(part.texels_per_m, pixels_per_m));
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(range.count), GL_UNSIGNED_INT,
                   // OpenGL ES takes an offset as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
                   reinterpret_cast<const void*>(std::uintptr_t{range.first} * sizeof(std::uint32_t)));
}

} // namespace frustumscreen::bench
