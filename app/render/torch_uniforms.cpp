#include "app/render/torch_uniforms.h"

#include "app/render/face_pass.h"

#include <GLES2/gl2ext.h>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace frustumscreen::render {

namespace {

void set_beam(const Shader& shader, const scene::TorchLight& light, const glm::vec2& inverse_z) {
    const torch::Beam& beam = light.torch.beam;
    glUniform4f(shader.location(Uniform::Beam), light.per_half_extent.x, light.per_half_extent.y,
                light.reach_m, beam.shape == torch::Shape::Round ? 1.0F : 0.0F);
    const glm::vec4 fall = fall_of(beam);
    glUniform4fv(shader.location(Uniform::Fall), 1, glm::value_ptr(fall));
    const glm::vec4 falloff_range(beam.full_m, 1.0 / (beam.dark_m - beam.full_m), light.torch.brightness,
                                  1e3 / light.torch.scale);
    glUniform4fv(shader.location(Uniform::FalloffRange), 1, glm::value_ptr(falloff_range));
    glUniform3f(shader.location(Uniform::InverseZ), inverse_z.x, inverse_z.y,
                static_cast<float>(slack_of(light)));
}

void set_stages(const Shader& shader, const scene::PlacedTorch& torch) {
    constexpr std::size_t count = torch::max_stages;
    std::array<glm::ivec2, count> kind{};
    std::array<glm::vec4, count> colour{};
    std::array<glm::vec3, count> size{};
    std::array<glm::mat3x2, count> frame{};
    for (std::size_t k = 0; k < torch.stage_count; ++k) {
        const torch::Stage& stage = torch.stages[k];
        kind[k] = {static_cast<int>(stage.source), static_cast<int>(stage.mix)};
        colour[k] = {stage.colour, torch.stages_at[k].opacity};
        size[k] = {stage.size, stage.width, stage.magnification};
        frame[k] = torch.stages_at[k].stage_from_content;
    }
    glUniform1i(shader.location(Uniform::ContentKind), static_cast<GLint>(torch.stage_count));
    glUniform2iv(shader.location(Uniform::StageKind), count, glm::value_ptr(kind[0]));
    glUniform4fv(shader.location(Uniform::StageColour), count, glm::value_ptr(colour[0]));
    glUniform3fv(shader.location(Uniform::StageSize), count, glm::value_ptr(size[0]));
    glUniformMatrix3x2fv(shader.location(Uniform::StageFromContent), count, GL_FALSE, &frame[0][0].x);
    glUniform1f(shader.location(Uniform::HeightPerWidth), static_cast<float>(torch.beam.height_per_width));
}

} // namespace

/// (full / distance)^2, but for InverseSquare without bound; and the polynomial's share, square and cube.
glm::vec4 fall_of(const torch::Beam& beam) {
    constexpr float unbounded = 1e30F;
    switch (beam.attenuation) {
    case torch::Attenuation::InverseSquare:
        return {beam.full_m * beam.full_m, 0.0F, 0.0F, 0.0F};
    case torch::Attenuation::Linear:
        return {unbounded, 1.0F, 0.0F, 0.0F};
    case torch::Attenuation::SmoothStep:
        return {unbounded, 0.0F, 3.0F, -2.0F};
    case torch::Attenuation::None:
        break;
    }
    return {unbounded, 0.0F, 0.0F, 0.0F};
}

const Shader* find_torch(const ShaderCache& shaders, const scene::ShaderKey& key,
                         const scene::TorchLight& light) {
    const std::uint8_t parts = scene::parts_of(light.torch);
    const Shader* const own = shaders.find(scene::torch_of(key, parts));
    const unsigned any = torch::all_parts | (parts & unsigned{torch::OverPart | torch::BarePart});
    return own != nullptr ? own : shaders.find(scene::torch_of(key, static_cast<std::uint8_t>(any)));
}

double slack_of(const scene::TorchLight& light) {
    const glm::dvec2 extent = torch::half_extent(light.torch.beam);
    return std::min({extent.x, extent.y, 1.0}) / scene::torch_picture_px;
}

bool shows_layer(const scene::TorchLight& light) {
    return (scene::parts_of(light.torch) & torch::LayerPart) != 0;
}

void bind(unsigned unit, unsigned texture) {
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_2D, texture);
    glActiveTexture(GL_TEXTURE0);
}

unsigned texture_of_framebuffer(unsigned attachment) {
    const auto ask = [attachment](GLenum what) {
        GLint answer = 0;
        glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment, what, &answer);
        return answer;
    };
    assert(ask(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) == GL_TEXTURE);
    return static_cast<unsigned>(ask(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME));
}

void set_torch(const Shader& shader, const scene::TorchLight& light, const TorchPicture& picture,
               const GpuStore& store) {
    set_beam(shader, light, picture.inverse_z);
    set_stages(shader, light.torch);
    const GpuStore::Texture* const content = store.find(light.torch.picture);
    bind(shadow_unit, picture.shadow);
    bind(content_unit, content != nullptr ? content->texels.get() : 0);
    bind(seen_unit, shows_own_view(light) ? picture.colour : 0);
}

void set_lit_face(const Shader& shader, const scene::FramePlan& plan, const scene::Draw& draw,
                  const Raster& raster) {
    const scene::FaceLight& light = plan.faces[static_cast<std::size_t>(draw.face)].light;
    const bool even = light.per_cubic_metre > 0.0F;
    const glm::vec4 ray = ray_from_fragment(plan.projector, raster);
    const glm::vec3 brightness = draw.brightness * draw.light;
    glUniform4fv(shader.location(Uniform::RayFromFragment), 1, glm::value_ptr(ray));
    glUniform3fv(shader.location(Uniform::InverseDepth), 1, glm::value_ptr(light.inverse_depth));
    glUniform4f(shader.location(Uniform::FaceGain), even ? light.per_cubic_metre : 1e30F,
                even ? light.most : 1.0F, 0.0F, 0.0F);
    glUniform3fv(shader.location(Uniform::Brightness), 1, glm::value_ptr(brightness));
}

void set_nearness(const Shader& shader, const scene::FramePlan& plan, const scene::TorchLight& light,
                  int face, const glm::ivec4& raster) {
    const glm::vec4& depth = plan.faces[static_cast<std::size_t>(face)].depth_from_nearness;
    glUniformMatrix4fv(shader.location(Uniform::TorchFromProjector), 1, GL_FALSE,
                       glm::value_ptr(light.torch_from_projector));
    glUniform3fv(shader.location(Uniform::Eye), 1, glm::value_ptr(light.eye));
    glUniform4fv(shader.location(Uniform::DepthFromNearness), 1, glm::value_ptr(depth));
    glUniform4i(shader.location(Uniform::Raster), raster.x, raster.y, raster.z, raster.w);
}

void set_depths(const Shader& shader, const scene::TorchFace& face, const glm::ivec4& raster) {
    const glm::mat4 from_ray(face.from_ray);
    glUniformMatrix4fv(shader.location(Uniform::TorchFromProjector), 1, GL_FALSE, glm::value_ptr(from_ray));
    glUniform3fv(shader.location(Uniform::Eye), 1, glm::value_ptr(face.eye));
    glUniform4f(shader.location(Uniform::DepthFromNearness), face.end_of_depth.x, face.end_of_depth.y, 0.0F,
                face.end_of_depth.z);
    glUniform4i(shader.location(Uniform::Raster), raster.x, raster.y, raster.z, raster.w);
}

scene::TextureId layer_of(const scene::TorchLight& light, const scene::Drawable& drawable) {
    for (std::size_t k = 0; k < light.torch.stage_count; ++k) {
        const torch::Stage& stage = light.torch.stages[k];
        if (stage.source == torch::Source::Layer && stage.item < drawable.layers.size()) {
            return drawable.layers[stage.item];
        }
    }
    return scene::TextureId::None;
}

bool shows_own_view(const scene::TorchLight& light) {
    const auto end = light.torch.stages.begin() + static_cast<std::ptrdiff_t>(light.torch.stage_count);
    return std::any_of(light.torch.stages.begin(), end,
                       [](const torch::Stage& stage) { return stage.source == torch::Source::Lens; });
}

void begin_blending(const scene::TorchLight& light) {
    const bool over = light.torch.blend == torch::Blend::Over;
    glEnable(GL_FRAMEBUFFER_SRGB_EXT);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(over ? GL_SRC_ALPHA : GL_DST_COLOR, over ? GL_ONE_MINUS_SRC_ALPHA : GL_ONE, GL_ZERO,
                        GL_ONE);
}

void end_blending() {
    glDisable(GL_BLEND);
    glDisable(GL_FRAMEBUFFER_SRGB_EXT);
}

int light_face(const Lit& lit, const scene::TorchFace& face, const Shader& shader,
               std::span<const PixelRectangle> parts) {
    const scene::TorchLight& light = lit.plan.torches[face.torch];
    set_torch(shader, light, lit.torches[face.torch], lit.store);
    set_lit_face(shader, lit.plan, lit.plan.draws[face.draw], lit.raster);
    begin_blending(light);
    int calls = 0;
    for (const PixelRectangle& part : parts) {
        set_scissor(part, lit.raster);
        calls += draw_outline(lit.plan.faces[static_cast<std::size_t>(face.face)].corners_clip, shader);
    }
    return calls;
}

} // namespace frustumscreen::render
