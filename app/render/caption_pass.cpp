#include "app/render/caption_pass.h"

#include "app/render/gl_memory.h"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <bit>

namespace frustumscreen {

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

CaptionPass CaptionPass::create() {
    CaptionPass pass;
    pass.no_attributes_ = GlVertexArray::generate();
    return pass;
}

int CaptionPass::draw(const CaptionPlan& plan, const CaptionGpu* caption, const ShaderCache& shaders) const {
    const Shader* const shader = shaders.find({ShaderKey::Pass::TablePicture});
    if (plan.bounds.empty() || caption == nullptr || shader == nullptr) {
        return 0;
    }
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    shader->use();
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, caption->texture());
    glBindVertexArray(no_attributes_.get());
    glUniform1f(shader->at(Uniform::Brightness), plan.brightness);
    glUniform4fv(shader->at(Uniform::Corners), 4, glm::value_ptr(plan.corners_clip[0]));
    glDrawArrays(GL_TRIANGLE_FAN, 0, 4);
    glUniform1f(shader->at(Uniform::Brightness), 0.0F);
    for (const std::array<glm::vec4, 4>& face : plan.prop_clip) {
        glUniform4fv(shader->at(Uniform::Corners), 4, glm::value_ptr(face[0]));
        glDrawArrays(GL_TRIANGLE_FAN, 0, 4);
    }
    glBindVertexArray(0);
    return 1 + static_cast<int>(plan.prop_clip.size());
}

} // namespace frustumscreen
