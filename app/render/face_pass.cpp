#include "app/render/face_pass.h"

#include <glm/gtc/type_ptr.hpp>

#include <cmath>

namespace frustumscreen {

namespace {

GLuint stencil_value(std::size_t face) {
    return static_cast<GLuint>(face) + 1U;
}

ShaderKey shader_for(const FramePlan& plan, const ArtifactGpu& artifact, FacePass::Output output) {
    ShaderKey key;
    key.cut_out = artifact.cut_out();
    key.dithered = plan.coming_share.has_value();
    key.even_light = plan.compensate_light;
    return output == FacePass::Output::Places ? places_of(key) : key;
}

} // namespace

FacePass FacePass::create() {
    FacePass pass;
    pass.no_attributes_ = GlVertexArray::generate();
    pass.indices_ = GlBuffer::generate();
    return pass;
}

int FacePass::draw(const FramePlan& plan, const Levels& levels, const ShaderCache& shaders,
                   const Raster& raster, Output output) const {
    const Shader* const outline = shaders.find({ShaderKey::Pass::Outline});
    if (plan.faces.empty() || levels.artifact == nullptr || outline == nullptr) {
        return 0;
    }
    glEnable(GL_STENCIL_TEST);
    glEnable(GL_SCISSOR_TEST);
    mark_faces(plan, *outline, raster);
    upload_indices(plan);
    auto calls = static_cast<int>(plan.faces.size());
    for (const ArtifactGpu* level : {levels.artifact, plan.coming_share ? levels.coming : nullptr}) {
        const Shader* const shader =
            level != nullptr ? shaders.find(shader_for(plan, *level, output)) : nullptr;
        calls += shader != nullptr ? draw_level(plan, *level, *shader, level == levels.coming, raster) : 0;
    }
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glBindVertexArray(0);
    return calls;
}

void FacePass::upload_indices(const FramePlan& plan) const {
    glBindVertexArray(no_attributes_.get()); // a vertex array keeps the buffer that is bound while it is
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.get());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(plan.indices.size() * sizeof(std::uint32_t)), plan.indices.data(),
                 GL_STREAM_DRAW);
}

void FacePass::mark_faces(const FramePlan& plan, const Shader& outline, const Raster& raster) const {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glDepthMask(GL_FALSE);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glStencilMask(0xFF);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    outline.use();
    glBindVertexArray(no_attributes_.get());
    for (std::size_t k = 0; k < plan.faces.size(); ++k) {
        // The prop is convex: faces that the projector sees do not hide each other.
        glStencilFunc(GL_ALWAYS, static_cast<GLint>(stencil_value(k)), 0xFF);
        set_scissor(plan.faces[k].bounds, raster);
        glUniform4fv(outline.at(Uniform::Corners), 4, glm::value_ptr(plan.faces[k].corners_clip[0]));
        glDrawArrays(GL_TRIANGLE_FAN, 0, 4);
    }
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
}

int FacePass::draw_level(const FramePlan& plan, const ArtifactGpu& artifact, const Shader& shader,
                         bool coming, const Raster& raster) const {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    // A face is lit from the side that it is seen from, so nothing is mirrored but y (row 0 is the top).
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glFrontFace(GL_CW);
    shader.use();
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, artifact.texture());
    glBindVertexArray(artifact.vertex_array());
    constexpr float code_power = 1.0F / 2.4F;
    glUniform2f(shader.at(Uniform::Brightness), plan.brightness, std::pow(plan.brightness, code_power));
    glUniform2f(shader.at(Uniform::Dither), plan.coming_share.value_or(0.0F), coming ? 1.0F : 0.0F);
    const glm::vec2 scale = 1.0F / glm::vec2(raster.fragments);
    glUniform4f(shader.at(Uniform::PixelFromFragment), scale.x, scale.y, static_cast<float>(raster.corner.x),
                static_cast<float>(raster.corner.y));
    const Pinhole& pinhole = plan.projector;
    glUniform4f(shader.at(Uniform::Pinhole), static_cast<float>(pinhole.cx), static_cast<float>(pinhole.cy),
                static_cast<float>(1.0 / pinhole.fx), static_cast<float>(1.0 / pinhole.fy));
    const std::array<glm::vec3, 2> prop_from_unit{glm::vec3(plan.prop_from_unit_scale),
                                                  glm::vec3(plan.prop_from_unit_offset)};
    glUniform3fv(shader.at(Uniform::PropFromUnit), 2, glm::value_ptr(prop_from_unit[0]));
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.get());
    const double samples_along = std::sqrt(static_cast<double>(raster.fragments.x * raster.fragments.y));
    int calls = 0;
    for (std::size_t k = 0; k < plan.faces.size(); ++k) {
        const FacePlan& face = plan.faces[k];
        glStencilFunc(GL_EQUAL, static_cast<GLint>(stencil_value(k)), 0xFF);
        glUniformMatrix4fv(shader.at(Uniform::ClipFromUnit), 1, GL_FALSE,
                           glm::value_ptr(face.clip_from_unit));
        glUniform1f(shader.at(Uniform::MipLevel), artifact.mip_level(samples_along * face.pixels_per_box));
        glUniform3fv(shader.at(Uniform::InverseDepth), 1, glm::value_ptr(face.light.inverse_depth));
        glUniform2f(shader.at(Uniform::FaceGain), face.light.constant, face.light.per_cubic_metre);
        const IndexRange& range = coming ? face.coming : face.shown;
        if (range.count == 0) {
            continue;
        }
        set_scissor(face.bounds, raster);
        const std::uintptr_t offset = std::uintptr_t{range.first} * sizeof(std::uint32_t);
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(range.count), GL_UNSIGNED_INT,
                       // OpenGL ES takes an offset as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
                       reinterpret_cast<const void*>(offset));
        ++calls;
    }
    return calls;
}

} // namespace frustumscreen
