#include "app/render/caption_pass.h"

#include "app/render/gl_memory.h"
#include "firmware_host/gl/gl_program.h"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <bit>

namespace frustumscreen {

namespace {

constexpr std::string_view vertex = R"(
uniform vec4 corners[4]; // top left, top right, bottom right, bottom left
out vec2 at;
void main() {
    gl_Position = corners[gl_VertexID];
    at = vec2(gl_VertexID == 1 || gl_VertexID == 2 ? 1.0 : 0.0, gl_VertexID >= 2 ? 1.0 : 0.0);
}
)";
constexpr std::string_view fragment = R"(
in vec2 at;
uniform sampler2D coverage;
uniform float brightness;
out vec4 result;
void main() { result = vec4(vec3(brightness * texture(coverage, at).r), 1.0); }
)";

} // namespace

Result<CaptionGpu> CaptionGpu::upload(const Image<std::uint8_t>& coverage) {
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (coverage.width < 1 || coverage.height < 1 || std::max(coverage.width, coverage.height) > limit) {
        return fail(
            ErrorKind::BadConfiguration,
            fmt::format(
                "render: a caption of {} x {} pixels; this driver allows 1 to {}: use smaller letters",
                coverage.width, coverage.height, limit));
    }
    CaptionGpu caption;
    caption.texture_ = GlTexture::generate();
    glBindTexture(GL_TEXTURE_2D, caption.texture_.get());
    const auto longest = static_cast<unsigned>(std::max(coverage.width, coverage.height));
    glTexStorage2D(GL_TEXTURE_2D, std::bit_width(longest), GL_R8, coverage.width, coverage.height);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, coverage.width, coverage.height, GL_RED, GL_UNSIGNED_BYTE,
                    coverage.texels.data());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return caption;
}

std::uint64_t CaptionGpu::bytes() const {
    return bytes_of_texture(texture_);
}

Result<CaptionPass> CaptionPass::create() {
    Result<GlProgram> program = make_program("", vertex, fragment);
    if (!program) {
        return tl::unexpected<Error>(program.error());
    }
    CaptionPass pass;
    pass.program_ = std::move(*program);
    pass.corners_ = glGetUniformLocation(pass.program_.get(), "corners");
    pass.brightness_ = glGetUniformLocation(pass.program_.get(), "brightness");
    pass.no_attributes_ = GlVertexArray::generate();
    glUseProgram(pass.program_.get());
    glUniform1i(glGetUniformLocation(pass.program_.get(), "coverage"), 0);
    return pass;
}

int CaptionPass::draw(const CaptionPlan& plan, const CaptionGpu* caption) const {
    if (plan.bounds.empty() || caption == nullptr) {
        return 0;
    }
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glUseProgram(program_.get());
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, caption->texture());
    glBindVertexArray(no_attributes_.get());
    glUniform1f(brightness_, plan.brightness);
    glUniform4fv(corners_, 4, glm::value_ptr(plan.corners_clip[0]));
    glDrawArrays(GL_TRIANGLE_FAN, 0, 4);
    glUniform1f(brightness_, 0.0F);
    for (const std::array<glm::vec4, 4>& face : plan.prop_clip) {
        glUniform4fv(corners_, 4, glm::value_ptr(face[0]));
        glDrawArrays(GL_TRIANGLE_FAN, 0, 4);
    }
    glBindVertexArray(0);
    return 1 + static_cast<int>(plan.prop_clip.size());
}

} // namespace frustumscreen
