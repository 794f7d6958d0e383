#include "app/bench/torch/paper_torch.h"

#include "app/render/raster.h"
#include "firmware_host/gl/gl_program.h"

#include <GLES2/gl2ext.h>
#include <glm/gtc/type_ptr.hpp>

#include <string_view>

namespace frustumscreen::bench {

namespace {

constexpr std::string_view vertex_source = R"(
layout(location = 0) in vec3 position; // over the mesh's box
layout(location = 1) in float intensity;
uniform mat4 clip_from_unit;
uniform mat4x3 beam_from_unit; // to (s, t, q)
out vec3 stq;
out float light;
void main() {
    gl_Position = clip_from_unit * vec4(position, 1.0);
    stq = beam_from_unit * vec4(position, 1.0);
    light = intensity;
}
)";
constexpr std::string_view fragment_source = R"(
in vec3 stq;
in float light;
uniform vec2 shape; // 1: round; the least intensity
out vec4 result;
void main() {
    vec2 at = stq.xy / stq.z;
    float away = shape.x > 0.5 ? dot(at, at) : max(abs(at.x), abs(at.y));
    if (stq.z <= 0.0 || away > 1.0 || light < shape.y) {
        discard;
    }
    result = vec4(vec3(1.0), light);
}
)";

/// More than a frame of a second has.
constexpr std::size_t max_lit_triangles = 2'000'000;

void begin(unsigned framebuffer, const scene::FramePlan& plan) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, plan.projector.width, plan.projector.height);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_FALSE);
    glStencilMask(0xFF);
    glEnable(GL_FRAMEBUFFER_SRGB_EXT); // blends in linear light
    glEnable(GL_SCISSOR_TEST);
    glEnable(GL_STENCIL_TEST);
    glStencilOp(GL_KEEP, GL_KEEP, GL_INVERT); // a pixel is lit once: what lies just behind may pass too
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glEnable(GL_POLYGON_OFFSET_FILL); // a split triangle's depth rounds otherwise than the whole one's
    glPolygonOffset(-1.0F, -4.0F);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
}

void end() {
    for (const GLenum off : {GLenum{GL_SCISSOR_TEST}, GLenum{GL_STENCIL_TEST}, GLenum{GL_DEPTH_TEST},
                             GLenum{GL_CULL_FACE}, GLenum{GL_BLEND}, GLenum{GL_POLYGON_OFFSET_FILL}}) {
        glDisable(off);
    }
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    glDepthMask(GL_TRUE);
    glBindVertexArray(0);
}

} // namespace

Result<PaperTorch> PaperTorch::create() {
    PaperTorch made;
    TRY(made.program_, gl::make_program("", vertex_source, fragment_source));
    made.clip_from_unit_ = glGetUniformLocation(made.program_.get(), "clip_from_unit");
    made.beam_from_unit_ = glGetUniformLocation(made.program_.get(), "beam_from_unit");
    made.shape_ = glGetUniformLocation(made.program_.get(), "shape");
    made.array_ = gl::GlVertexArray::generate();
    made.buffer_ = gl::GlBuffer::generate();
    glBindVertexArray(made.array_.get());
    glBindBuffer(GL_ARRAY_BUFFER, made.buffer_.get());
    constexpr GLsizei stride = sizeof(torch::LitCorner);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, stride, nullptr);
    glEnableVertexAttribArray(1);
    glVertexAttribPointer(1, 1, GL_FLOAT, GL_FALSE, stride,
                          // OpenGL ES takes an offset as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
                          reinterpret_cast<const void*>(sizeof(glm::vec3)));
    glBindVertexArray(0);
    return made;
}

void PaperTorch::build_draw(const std::vector<glm::dvec3>& positions, const scene::FramePlan& plan,
                            const scene::Draw& draw, const glm::dmat4& torch_from_unit,
                            const torch::TriangleSplitter& splitter, const torch::Splitting& splitting) {
    ++number_;
    if (corners_.size() < positions.size()) {
        corners_.resize(positions.size());
        made_.resize(positions.size(), 0);
    }
    const auto corner = [&](std::uint32_t index) -> const torch::MeshCorner& {
        if (made_[index] != number_) {
            made_[index] = number_;
            const glm::dvec3& unit = positions[index];
            corners_[index] = splitter.corner(glm::dvec3(torch_from_unit * glm::dvec4(unit, 1.0)), unit);
        }
        return corners_[index];
    };
    for (std::size_t k = draw.range.first; k < draw.range.first + draw.range.count; k += 3) {
        splitter.split({corner(plan.indices[k]), corner(plan.indices[k + 1]), corner(plan.indices[k + 2])},
                       splitting, lit_);
    }
}

void PaperTorch::build(const TorchSet& set, const scene::FramePlan& plan, const glm::dmat4& torch_from_prop,
                       const torch::Splitting& splitting, const torch::Beam& beam) {
    lit_.clear();
    ranges_.clear();
    const torch::TriangleSplitter splitter(beam);
    torch::Splitting limited = splitting;
    limited.max_triangles = max_lit_triangles;
    for (std::size_t k = 0; k < plan.draws.size(); ++k) {
        const scene::Draw& draw = plan.draws[k];
        if (draw.face == scene::Draw::on_table || draw.range.count == 0) {
            continue;
        }
        const std::size_t first = lit_.size();
        build_draw(set.unit_positions(draw.drawable.mesh), plan, draw,
                   torch_from_prop * glm::dmat4(draw.prop_from_unit), splitter, limited);
        if (lit_.size() > first) {
            ranges_.push_back({k, first, lit_.size() - first});
        }
    }
    glBindBuffer(GL_ARRAY_BUFFER, buffer_.get());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(lit_.size() * sizeof(torch::LitCorner)),
                 lit_.data(), GL_STREAM_DRAW);
}

void PaperTorch::draw(const TorchSet& set, const scene::FramePlan& plan, const glm::dmat4& torch_from_prop,
                      const torch::Beam& beam, const torch::Splitting& splitting, unsigned framebuffer) {
    const Key key{plan.hash, torch_from_prop, splitting.tolerance, splitting.by};
    if (!(key == key_)) {
        build(set, plan, torch_from_prop, splitting, beam);
        key_ = key;
    }
    if (ranges_.empty()) {
        return;
    }
    begin(framebuffer, plan);
    glUseProgram(program_.get());
    glUniform2f(shape_, beam.shape == torch::Shape::Round ? 1.0F : 0.0F,
                static_cast<float>(torch::min_intensity));
    glBindVertexArray(array_.get());
    const glm::dvec3 per_half_extent(1.0 / torch::half_extent(beam), 1.0);
    for (const Range& range : ranges_) {
        const scene::Draw& draw = plan.draws[range.draw];
        const glm::dmat4 torch_from_unit = torch_from_prop * glm::dmat4(draw.prop_from_unit);
        glm::mat4x3 beam_from_unit(1.0F);
        for (int column = 0; column < 4; ++column) {
            beam_from_unit[column] = glm::vec3(per_half_extent * glm::dvec3(torch_from_unit[column]));
        }
        glUniformMatrix4fv(clip_from_unit_, 1, GL_FALSE, glm::value_ptr(draw.clip_from_unit));
        glUniformMatrix4x3fv(beam_from_unit_, 1, GL_FALSE, glm::value_ptr(beam_from_unit));
        glStencilFunc(GL_EQUAL,
                      static_cast<GLint>(render::stencil_value(static_cast<std::size_t>(draw.face))), 0xFF);
        render::set_scissor(draw.bounds);
        glFrontFace(glm::determinant(glm::mat3(draw.prop_from_unit)) < 0.0F ? GL_CCW : GL_CW);
        glDrawArrays(GL_TRIANGLES, static_cast<GLint>(range.first), static_cast<GLsizei>(range.count));
    }
    end();
}

} // namespace frustumscreen::bench
