#include "app/render/face_pass.h"

#include "app/geometry/corner_fan.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace frustumscreen::render {

namespace {

/// A factor of light to this power is the factor of codes: sRGB's own power, away from black.
constexpr float code_power = 1.0F / 2.4F;
/// Bit of the stencil that marks what a torch has lit; faces have the lower ones.
constexpr GLuint lit_bit = 0x80;
static_assert(geometry::max_faces < lit_bit);

void set_view(const Shader& shader, const geometry::Pinhole& pinhole, const Raster& raster) {
    const glm::vec4 pixel(1.0F / glm::vec2(raster.fragments), raster.corner);
    const glm::vec4 ray = ray_from_fragment(pinhole, raster);
    shader.bend_by(pinhole); // a torch's own picture is straight
    glUniform4fv(shader.location(Uniform::PixelFromFragment), 1, glm::value_ptr(pixel));
    glUniform4fv(shader.location(Uniform::RayFromFragment), 1, glm::value_ptr(ray));
}

void set_face(const Shader& shader, const scene::FaceLight& light) {
    glUniform3fv(shader.location(Uniform::InverseDepth), 1, glm::value_ptr(light.inverse_depth));
    glUniform4f(shader.location(Uniform::FaceGain), light.per_cubic_metre, light.most,
                std::pow(light.per_cubic_metre, code_power), std::pow(light.most, code_power));
}

void set_draw(const Shader& shader, const scene::Draw& draw) {
    glUniform2f(shader.location(Uniform::Dither), draw.dither.share, draw.dither.complement ? 0.0F : 1.0F);
    const std::array<glm::vec3, 2> light{draw.light, glm::pow(draw.light, glm::vec3(code_power))};
    glUniform3fv(shader.location(Uniform::Light), 2, glm::value_ptr(light[0]));
    glUniformMatrix4fv(shader.location(Uniform::PropFromUnit), 1, GL_FALSE,
                       glm::value_ptr(draw.prop_from_unit));
    glUniformMatrix4fv(shader.location(Uniform::ClipFromUnit), 1, GL_FALSE,
                       glm::value_ptr(draw.clip_from_unit));
}

/// The uploaded mip level for ::mip_level, one for the whole draw: choosing and mixing two levels for each
/// pixel costs a software or small GPU more than the rest of the pixel.
int mip_of(const scene::Draw& draw, const GpuStore::Texture& texture, const Raster& raster) {
    const double samples_along = std::sqrt(static_cast<double>(raster.fragments.x * raster.fragments.y));
    const int mip =
        scene::mip_level(draw.drawable.material.texels_per_box, samples_along * draw.pixels_per_box);
    return std::max(mip - texture.finest_mip, 0);
}

/// Several samples a pixel are drawn in all colours, because only their mean is written in those of the eye.
glm::bvec3 channels_of(const scene::FramePlan& plan, const Raster& raster) {
    return raster.fragments == glm::ivec2(1) ? plan.picture.channels : glm::bvec3(true);
}

int outline_calls(const scene::FramePlan& plan) {
    std::size_t quads = 0;
    for (const scene::FacePlan& face : plan.faces) {
        quads += geometry::fan_quads(face.corners_clip.size());
    }
    return static_cast<int>(quads);
}

} // namespace

int draw_outline(std::span<const glm::vec4> corners, const Shader& shader) {
    const std::size_t quads = geometry::fan_quads(corners.size());
    for (std::size_t k = 0; k < quads; ++k) {
        const auto [a, b, c, d] = geometry::fan_quad(corners.size(), k);
        const std::array<glm::vec4, 4> quad{corners[a], corners[b], corners[c], corners[d]};
        glUniform4fv(shader.location(Uniform::Corners), 4, glm::value_ptr(quad[0]));
        shader.draw_quad();
    }
    return static_cast<int>(quads);
}

bool FacePass::draws(const scene::FramePlan& plan) {
    return std::any_of(plan.draws.begin(), plan.draws.end(), [](const scene::Draw& draw) {
        return draw.shader.pass == scene::ShaderKey::Pass::Surface;
    });
}

int FacePass::draw(const scene::FramePlan& plan, const GpuStore& store, const ShaderCache& shaders,
                   const Raster& raster, Output output, relief::Facing facing) {
    const Shader* const outline = shaders.find({scene::ShaderKey::Pass::Outline});
    if (!draws(plan) || outline == nullptr) {
        return 0;
    }
    glEnable(GL_STENCIL_TEST);
    glEnable(GL_SCISSOR_TEST);
    mark_faces(plan, *outline, raster);
    upload_indices(plan);
    blocks_.list(plan, store, facing);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glEnable(GL_CULL_FACE);
    glCullFace(facing == relief::Facing::Eye ? GL_BACK : GL_FRONT);
    int calls = outline_calls(plan);
    for (const scene::Draw& draw : plan.draws) {
        if (draw.shader.pass != scene::ShaderKey::Pass::Surface) {
            continue;
        }
        const Shader* const shader =
            shaders.find(output == Output::Places ? scene::places_of(draw.shader) : draw.shader);
        const GpuStore::Mesh* const mesh = store.find(draw.drawable.mesh);
        const GpuStore::Blocks* const blocks = store.find_blocks(draw.drawable.mesh);
        const GpuStore::Texture* const texture = store.find(draw.drawable.material.texture);
        if (shader == nullptr || texture == nullptr || (mesh == nullptr && blocks == nullptr)) {
            continue;
        }
        begin_surface(plan, draw, *texture, *shader, raster);
        glUniform2f(shader->location(Uniform::Brightness), draw.brightness,
                    std::pow(draw.brightness, code_power));
        if (mesh != nullptr) {
            draw_mesh(draw, draw.range, *mesh);
        } else {
            glFrontFace(GL_CW); // the shader mirrors
            blocks_.draw(plan, draw, plan.relief_draws[draw.relief_draw].prop_from_box, *blocks, *shader);
        }
        ++calls;
    }
    if (output == Output::Colours) {
        calls += soften_edges(plan, shaders, raster);
    }
    glCullFace(GL_BACK);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glBindVertexArray(0);
    return calls;
}

int FacePass::soften_edges(const scene::FramePlan& plan, const ShaderCache& shaders,
                           const Raster& raster) const {
    const Shader* const shader = shaders.find({scene::ShaderKey::Pass::EdgeFeather});
    if (plan.feathers.empty() || shader == nullptr) {
        return 0;
    }
    shader->use();
    glBindVertexArray(no_attributes_.get());
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ZERO, GL_SRC_COLOR);
    for (const scene::EdgeFeather& feather : plan.feathers) {
        const auto face = static_cast<std::size_t>(feather.face);
        glStencilFunc(GL_EQUAL, static_cast<GLint>(stencil_value(face)), 0xFF);
        set_scissor(plan.faces[face].bounds, raster);
        glUniform4fv(shader->location(Uniform::Corners), 4, glm::value_ptr(feather.corners_clip[0]));
        glUniform2f(shader->location(Uniform::EdgeShare), feather.share.x, feather.share.y);
        shader->draw_quad();
    }
    glDisable(GL_BLEND);
    return static_cast<int>(plan.feathers.size());
}

void FacePass::mark(const scene::FramePlan& plan, const ShaderCache& shaders, const Raster& raster) const {
    const Shader* const outline = shaders.find({scene::ShaderKey::Pass::Outline});
    if (outline == nullptr) {
        return;
    }
    glEnable(GL_STENCIL_TEST);
    glEnable(GL_SCISSOR_TEST);
    mark_faces(plan, *outline, raster);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_SCISSOR_TEST);
    glBindVertexArray(0);
}

int FacePass::light_layers(const Lit& lit) const {
    const scene::FramePlan& plan = lit.plan;
    if (!draws(plan) || lit.torches.empty()) {
        return 0;
    }
    glEnable(GL_STENCIL_TEST);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_FALSE);
    glEnable(GL_CULL_FACE);
    // The shaders' positions are invariant. An offset by the slope would light surfaces behind a steep outline.
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(0.0F, -2.0F);
    set_channels(channels_of(plan, lit.raster));
    glStencilOp(GL_KEEP, GL_KEEP, GL_INVERT); // of one bit: a fragment is lit once by a torch
    glStencilMask(lit_bit);
    int calls = 0;
    for (std::size_t torch = 0; torch < lit.torches.size(); ++torch) {
        if (!shows_layer(plan.torches[torch])) {
            continue;
        }
        glDisable(GL_SCISSOR_TEST);
        glClearStencil(0);
        glClear(GL_STENCIL_BUFFER_BIT);
        glEnable(GL_SCISSOR_TEST);
        begin_blending(plan.torches[torch]);
        for (const scene::TorchDraw& draw : plan.torch_draws) {
            calls += draw.torch == torch ? light_draw(lit, draw) : 0;
        }
    }
    end_blending();
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    glStencilMask(0xFF);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDepthMask(GL_TRUE);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glBindVertexArray(0);
    return calls;
}

int FacePass::light_draw(const Lit& lit, const scene::TorchDraw& lit_draw) const {
    const scene::Draw& draw = lit.plan.draws[lit_draw.draw];
    const scene::TorchLight& light = lit.plan.torches[lit_draw.torch];
    const Shader* const shader = find_torch(lit.shaders, draw.shader, light);
    const GpuStore::Mesh* const mesh = lit.store.find(draw.drawable.mesh);
    const GpuStore::Blocks* const blocks = lit.store.find_blocks(draw.drawable.mesh);
    const GpuStore::Texture* const texture = lit.store.find(draw.drawable.material.texture);
    if (draw.shader.pass != scene::ShaderKey::Pass::Surface || shader == nullptr || texture == nullptr ||
        (mesh == nullptr && blocks == nullptr)) {
        return 0;
    }
    begin_surface(lit.plan, draw, *texture, *shader, lit.raster);
    set_torch(*shader, light, lit.torches[lit_draw.torch], lit.store);
    set_lit_face(*shader, lit.plan, draw, lit.raster);
    const GpuStore::Texture* const layer = lit.store.find(layer_of(light, draw.drawable));
    bind(layer_unit, layer != nullptr ? layer->texels.get() : 0);
    if (mesh != nullptr) {
        const glm::mat4 torch_from_unit(light.torch_from_prop * glm::dmat4(draw.prop_from_unit));
        glUniformMatrix4fv(shader->location(Uniform::PropFromUnit), 1, GL_FALSE,
                           glm::value_ptr(torch_from_unit));
        draw_mesh(draw, lit_draw.range.count > 0 ? lit_draw.range : draw.range, *mesh);
    } else {
        glFrontFace(GL_CW); // the shader mirrors
        blocks_.draw(lit.plan, draw,
                     light.torch_from_prop * lit.plan.relief_draws[draw.relief_draw].prop_from_box, *blocks,
                     *shader);
    }
    return 1;
}

void FacePass::upload_indices(const scene::FramePlan& plan) const {
    glBindVertexArray(no_attributes_.get()); // a bound vertex array stores the next binding
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.get());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(plan.indices.size() * sizeof(std::uint32_t)), plan.indices.data(),
                 GL_STREAM_DRAW);
}

void FacePass::mark_faces(const scene::FramePlan& plan, const Shader& outline, const Raster& raster) const {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glDepthMask(GL_FALSE);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glStencilMask(0xFF);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    outline.use();
    outline.bend_by(plan.projector);
    glBindVertexArray(no_attributes_.get());
    for (std::size_t k = 0; k < plan.faces.size(); ++k) {
        // The prop is convex: faces that the projector sees do not hide each other.
        glStencilFunc(GL_ALWAYS, static_cast<GLint>(stencil_value(k)), 0xFF);
        set_scissor(plan.faces[k].bounds, raster);
        draw_outline(plan.faces[k].corners_clip, outline);
    }
    if (!plan.cover_clip.empty()) { // a window has one face
        glStencilFunc(GL_ALWAYS, 0, 0xFF);
        draw_outline(plan.cover_clip, outline);
    }
    glDepthMask(GL_TRUE);
    set_channels(channels_of(plan, raster));
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
}

void FacePass::begin_surface(const scene::FramePlan& plan, const scene::Draw& draw,
                             const GpuStore::Texture& texture, const Shader& shader,
                             const Raster& raster) const {
    const auto face = static_cast<std::size_t>(draw.face);
    shader.use();
    set_view(shader, plan.projector, raster);
    set_face(shader, plan.faces[face].light);
    set_draw(shader, draw);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, texture.texels.get());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, mip_of(draw, texture, raster));
    glStencilFunc(GL_EQUAL, static_cast<GLint>(stencil_value(face)), 0xFF);
    set_scissor(draw.bounds, raster);
}

void FacePass::draw_mesh(const scene::Draw& draw, const scene::IndexRange& range,
                         const GpuStore::Mesh& mesh) const {
    // A face is lit from the side that it is seen from, so only y is mirrored (row 0 is the top), unless a cell's pose
    // mirrors too.
    glFrontFace(glm::determinant(glm::mat3(draw.prop_from_unit)) < 0.0F ? GL_CCW : GL_CW);
    glBindVertexArray(mesh.vertex_array.get());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.get());
    const std::uintptr_t offset = std::uintptr_t{range.first} * sizeof(std::uint32_t);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(range.count), GL_UNSIGNED_INT,
                   // OpenGL ES takes an offset as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
                   reinterpret_cast<const void*>(offset));
}

} // namespace frustumscreen::render
