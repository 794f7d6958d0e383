#include "app/render/face_pass.h"

#include "firmware_host/gl/gl_program.h"

#include <glm/gtc/type_ptr.hpp>

#include <cmath>
#include <string>

namespace frustumscreen {

namespace {

constexpr std::string_view outline_vertex = R"(
uniform vec4 corners[4];
void main() { gl_Position = corners[gl_VertexID]; }
)";
constexpr std::string_view outline_fragment = R"(
void main() {}
)";

constexpr std::string_view artifact_vertex = R"(
layout(location = 0) in vec3 position; // 0..1 over the artifact's box
uniform mat4 clip_from_unit;
#ifdef HIT_POINT
uniform vec3 prop_from_unit[2]; // scale, offset
out vec3 point;
#endif
#if !defined(HIT_POINT) || defined(CUT_OUT)
layout(location = 1) in vec2 uv;
out vec2 texel;
#endif
void main() {
    gl_Position = clip_from_unit * vec4(position, 1.0);
#ifdef HIT_POINT
    point = prop_from_unit[0] * position + prop_from_unit[1];
#endif
#if !defined(HIT_POINT) || defined(CUT_OUT)
    texel = uv;
#endif
}
)";

constexpr std::string_view artifact_fragment = R"(
out vec4 result;
#if !defined(HIT_POINT) || defined(CUT_OUT)
in vec2 texel;
uniform sampler2D colour;
uniform float mip_level;
#endif
#ifdef HIT_POINT
in vec3 point;
void main() {
#ifdef CUT_OUT
    if (textureLod(colour, texel, mip_level).a < 0.5) {
        discard;
    }
#endif
    result = vec4(point, 1.0);
}
#else
uniform vec2 brightness; // the factor in linear light; to the power of 1 / 2.4
#if defined(COMPENSATED) || defined(FADING)
uniform vec4 pixel_from_fragment; // scale, offset
#endif
#ifdef FADING
uniform vec2 fade; // share of the pixels that the coming level draws; 1 = this is the coming level, 0 = the other
// Bayer's matrix of 8 x 8: 64 thresholds, each once in every 8 x 8 pixels.
bool is_other_levels() {
    ivec2 p = ivec2(gl_FragCoord.xy * pixel_from_fragment.xy + pixel_from_fragment.zw);
    int q = p.x ^ p.y;
    int rank = (q & 1) << 5 | (p.y & 1) << 4 | (q & 2) << 2 | (p.y & 2) << 1 | (q & 4) >> 1 | (p.y & 4) >> 2;
    return ((float(rank) + 0.5) / 64.0 < fade.x) != (fade.y > 0.5);
}
#endif
#ifdef COMPENSATED
uniform vec4 pinhole;       // cx, cy, 1 / fx, 1 / fy
uniform vec3 inverse_depth; // of the face's plane
uniform vec2 face_gain;     // constant, times d^3
float compensation() {
    vec2 pixel = gl_FragCoord.xy * pixel_from_fragment.xy + pixel_from_fragment.zw;
    vec2 ray = (pixel - pinhole.xy) * pinhole.zw;
    float depth = 1.0 / dot(inverse_depth, vec3(pixel, 1.0));
    float d2 = depth * depth * (1.0 + dot(ray, ray));
    return min(1.0, face_gain.x + face_gain.y * d2 * sqrt(d2));
}
#endif
void main() {
#ifdef FADING
    if (is_other_levels()) {
        discard;
    }
#endif
    vec4 seen = textureLod(colour, texel, mip_level);
#ifdef CUT_OUT
    if (seen.a < 0.5) {
        discard;
    }
#endif
    vec3 code = seen.rgb;
    vec2 gain = brightness;
#ifdef COMPENSATED
    float compensated = compensation();
    gain *= vec2(compensated, pow(compensated, 1.0 / 2.4));
#endif
    // The code of `gain` times the light of a code, by sRGB's own power law; its straight piece near black exactly.
    result = vec4(max(gain.x * code, (code + 0.055) * gain.y - 0.055), 1.0);
}
#endif
)";

GLuint stencil_value(std::size_t face) {
    return static_cast<GLuint>(face) + 1U;
}

} // namespace

Result<FacePass::ArtifactProgram> FacePass::make_artifact_program(std::string_view defines) {
    Result<GlProgram> program = make_program(defines, artifact_vertex, artifact_fragment);
    if (!program) {
        return tl::unexpected<Error>(program.error());
    }
    const GLuint name = program->get();
    ArtifactProgram made{std::move(*program),
                         glGetUniformLocation(name, "clip_from_unit"),
                         glGetUniformLocation(name, "mip_level"),
                         glGetUniformLocation(name, "brightness"),
                         glGetUniformLocation(name, "pixel_from_fragment"),
                         glGetUniformLocation(name, "pinhole"),
                         glGetUniformLocation(name, "inverse_depth"),
                         glGetUniformLocation(name, "face_gain"),
                         glGetUniformLocation(name, "prop_from_unit"),
                         glGetUniformLocation(name, "fade")};
    glUseProgram(name);
    glUniform1i(glGetUniformLocation(name, "colour"), 0);
    return made;
}

Result<FacePass> FacePass::create(FaceOutput output, const Variants& variants) {
    FacePass pass;
    for (unsigned variant = 0; variant < AllVariants; ++variant) {
        const bool compensated = (variant & Compensated) != 0;
        const bool fading = (variant & Fading) != 0;
        const bool cut_out = (variant & CutOut) != 0;
        if (!(compensated ? variants.compensated : variants.plain) || (fading && !variants.level_fades) ||
            (cut_out && !variants.cut_out)) {
            continue;
        }
        std::string defines = compensated ? "#define COMPENSATED\n" : "";
        defines += fading ? "#define FADING\n" : "";
        if (output == FaceOutput::HitPoint) {
            defines = "#define HIT_POINT\n";
        }
        defines += cut_out ? "#define CUT_OUT\n" : "";
        Result<ArtifactProgram> program = make_artifact_program(defines);
        if (!program) {
            return tl::unexpected<Error>(program.error());
        }
        pass.programs_.at(variant) = std::move(*program);
    }
    Result<GlProgram> outline = make_program("", outline_vertex, outline_fragment);
    if (!outline) {
        return tl::unexpected<Error>(outline.error());
    }
    pass.outline_ = std::move(*outline);
    pass.outline_corners_ = glGetUniformLocation(pass.outline_.get(), "corners");
    pass.no_attributes_ = GlVertexArray::generate();
    pass.indices_ = GlBuffer::generate();
    return pass;
}

void FacePass::list_programs(std::vector<Program>& programs) const {
    constexpr std::array<Program, AllVariants> names{
        Program::Artifact,       Program::ArtifactCompensated,
        Program::ArtifactFading, Program::ArtifactCompensatedFading,
        Program::CutOut,         Program::CutOutCompensated,
        Program::CutOutFading,   Program::CutOutCompensatedFading};
    if (outline_.get() != 0) {
        programs.push_back(Program::Outline);
    }
    for (std::size_t variant = 0; variant < names.size(); ++variant) {
        if (programs_.at(variant)) {
            programs.push_back(names.at(variant));
        }
    }
}

const FacePass::ArtifactProgram* FacePass::program_for(bool compensated, bool fading, bool cut_out) const {
    const bool can_cut_out = programs_.at(CutOut) || programs_.at(CutOut | Compensated);
    const unsigned rest = (fading ? Fading : 0U) | (cut_out && can_cut_out ? CutOut : 0U);
    const auto& wanted = programs_.at((compensated ? Compensated : 0U) | rest);
    const auto& other = programs_.at((compensated ? 0U : Compensated) | rest);
    return wanted ? &*wanted : (other ? &*other : nullptr);
}

int FacePass::draw(const FramePlan& plan, const Levels& levels, const Raster& raster) const {
    if (plan.faces.empty() || levels.artifact == nullptr) {
        return 0;
    }
    glEnable(GL_STENCIL_TEST);
    glEnable(GL_SCISSOR_TEST);
    mark_faces(plan, raster);
    upload_indices(plan);
    int calls = draw_level(plan, *levels.artifact, false, raster);
    if (plan.coming_share && levels.coming != nullptr) {
        calls += draw_level(plan, *levels.coming, true, raster);
    }
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glBindVertexArray(0);
    return calls + static_cast<int>(plan.faces.size());
}

void FacePass::upload_indices(const FramePlan& plan) const {
    glBindVertexArray(no_attributes_.get()); // a vertex array keeps the buffer that is bound while it is
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.get());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(plan.indices.size() * sizeof(std::uint32_t)), plan.indices.data(),
                 GL_STREAM_DRAW);
}

void FacePass::mark_faces(const FramePlan& plan, const Raster& raster) const {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glDepthMask(GL_FALSE);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glStencilMask(0xFF);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    glUseProgram(outline_.get());
    glBindVertexArray(no_attributes_.get());
    for (std::size_t k = 0; k < plan.faces.size(); ++k) {
        // The prop is convex: faces that the projector sees do not hide each other.
        glStencilFunc(GL_ALWAYS, static_cast<GLint>(stencil_value(k)), 0xFF);
        set_scissor(plan.faces[k].bounds, raster);
        glUniform4fv(outline_corners_, 4, glm::value_ptr(plan.faces[k].corners_clip[0]));
        glDrawArrays(GL_TRIANGLE_FAN, 0, 4);
    }
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
}

int FacePass::draw_level(const FramePlan& plan, const ArtifactGpu& artifact, bool coming,
                         const Raster& raster) const {
    // A renderer that was made without fades draws the first level alone, whole.
    const bool fading =
        plan.coming_share && program_for(plan.compensate_light, true, artifact.cut_out()) != nullptr;
    const ArtifactProgram* const found = program_for(plan.compensate_light, fading, artifact.cut_out());
    if (found == nullptr || (coming && !fading)) {
        return 0;
    }
    const ArtifactProgram& program = *found;
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    // A face is lit from the side that it is seen from, so nothing is mirrored but y (row 0 is the top).
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glFrontFace(GL_CW);
    glUseProgram(program.program.get());
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, artifact.texture());
    glBindVertexArray(artifact.vertex_array());
    constexpr float code_power = 1.0F / 2.4F;
    glUniform2f(program.brightness, plan.brightness, std::pow(plan.brightness, code_power));
    glUniform2f(program.fade, plan.coming_share.value_or(0.0F), coming ? 1.0F : 0.0F);
    const glm::vec2 scale = 1.0F / glm::vec2(raster.fragments);
    glUniform4f(program.pixel_from_fragment, scale.x, scale.y, static_cast<float>(raster.corner.x),
                static_cast<float>(raster.corner.y));
    const Pinhole& pinhole = plan.projector;
    glUniform4f(program.pinhole, static_cast<float>(pinhole.cx), static_cast<float>(pinhole.cy),
                static_cast<float>(1.0 / pinhole.fx), static_cast<float>(1.0 / pinhole.fy));
    const std::array<glm::vec3, 2> prop_from_unit{glm::vec3(plan.prop_from_unit_scale),
                                                  glm::vec3(plan.prop_from_unit_offset)};
    glUniform3fv(program.prop_from_unit, 2, glm::value_ptr(prop_from_unit[0]));
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.get());
    const double samples_along = std::sqrt(static_cast<double>(raster.fragments.x * raster.fragments.y));
    int calls = 0;
    for (std::size_t k = 0; k < plan.faces.size(); ++k) {
        const FacePlan& face = plan.faces[k];
        glStencilFunc(GL_EQUAL, static_cast<GLint>(stencil_value(k)), 0xFF);
        glUniformMatrix4fv(program.clip_from_unit, 1, GL_FALSE, glm::value_ptr(face.clip_from_unit));
        glUniform1f(program.mip_level, artifact.mip_level(samples_along * face.pixels_per_box));
        glUniform3fv(program.inverse_depth, 1, glm::value_ptr(face.light.inverse_depth));
        glUniform2f(program.gain, face.light.constant, face.light.per_cubic_metre);
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
