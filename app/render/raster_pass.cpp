#include "app/render/raster_pass.h"

#include "app/render/gl_memory.h"
#include "firmware_host/base/usable_cores.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <span>
#include <utility>

namespace frustumscreen::render {

namespace {

/// True if the relief can be copied there: all colours are written, no fade, no mesh, no picture on the table. A face drawn in black
/// under such a picture does not matter, because the relief's unlit pixels are black too.
bool stands_alone(const scene::FramePlan& plan, const PixelRectangle& part) {
    return plan.relief_draw_count == 1 && glm::all(plan.picture.channels) &&
           std::none_of(plan.draws.begin(), plan.draws.end(), [&](const scene::Draw& draw) {
               const bool black = draw.face == scene::Draw::on_table &&
                                  draw.drawable.material.texture == scene::TextureId::None;
               return draw.shader.pass == scene::ShaderKey::Pass::Raster
                          ? draw.shader.dithered
                          : !black && !intersected(draw.bounds, part).empty();
           });
}

/// The colour texture of the framebuffer that is drawn into.
GLuint texture_of_framebuffer() {
    const auto ask = [](GLenum what) {
        GLint answer = 0;
        glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, what, &answer);
        return answer;
    };
    assert(ask(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) == GL_TEXTURE);
    return static_cast<GLuint>(ask(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME));
}

} // namespace

Result<void> RasterPass::prepare(std::size_t relief_draws, int width, int height) {
    if (relief_draws > 0 && !painter_) {
        painter_ = std::make_unique<relief::ReliefPainter>(static_cast<int>(usable_cores()));
        memory_ = image::Image8(width, height);
    }
    while (pictures_.size() < relief_draws) {
        Picture picture{gl::GlTexture::generate(), {}};
        glBindTexture(GL_TEXTURE_2D, picture.texels.get());
        glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, width, height);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        // Touches the driver's pages now, instead of when a shader first reads them.
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE,
                        memory_.texels.data());
        if (glGetError() != GL_NO_ERROR) {
            return fail(
                ErrorKind::BadConfiguration, "render.no_room_for_cast",
                "render: the driver has no memory for a picture that is cast; use a technique of meshes");
        }
        pictures_.push_back(std::move(picture));
    }
    return {};
}

void RasterPass::paint(const scene::FramePlan& plan, const GpuStore& store) {
    for (std::size_t k = 0; k < pictures_.size(); ++k) {
        Picture& picture = pictures_[k];
        picture.painted.clear();
        picture.copied = 0;
        const relief::BlockRelief* const relief = k < plan.relief_draw_count && !plan.relief_draws[k].on_gpu
                                                      ? store.find_relief(plan.relief_draws[k].relief)
                                                      : nullptr;
        if (relief == nullptr) {
            continue;
        }
        light_.begin(plan, k);
        const std::span<const PixelRectangle> painted =
            painter_->paint(*relief, plan.relief_draws[k].view, plan.relief_draws[k].samples,
                            {.first = memory_.texels.data(),
                             .width = memory_.width,
                             .height = memory_.height,
                             .stride = memory_.width},
                            &light_);
        picture.painted.assign(painted.begin(), painted.end());
        const auto drawn =
            std::partition(picture.painted.begin(), picture.painted.end(),
                           [&](const PixelRectangle& part) { return stands_alone(plan, part); });
        picture.copied = static_cast<std::size_t>(drawn - picture.painted.begin());
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_2D, picture.texels.get());
        upload(std::span(picture.painted).subspan(picture.copied), plan.picture.viewport);
    }
}

void RasterPass::upload(std::span<const PixelRectangle> parts, const PixelRectangle& viewport) const {
    glPixelStorei(GL_UNPACK_ROW_LENGTH, memory_.width);
    for (const PixelRectangle& part : parts) {
        glTexSubImage2D(GL_TEXTURE_2D, 0, viewport.x + part.x, viewport.y + part.y, part.width, part.height,
                        GL_RGBA, GL_UNSIGNED_BYTE, &memory_.at(part.x, part.y));
    }
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

int RasterPass::show(const scene::FramePlan& plan, const ShaderCache& shaders) const {
    glBindVertexArray(no_attributes_.get());
    glActiveTexture(GL_TEXTURE0);
    int calls = 0;
    for (std::size_t k = 0; k < std::min(plan.relief_draw_count, pictures_.size()); ++k) {
        const std::span<const PixelRectangle> painted(pictures_[k].painted);
        const std::span<const PixelRectangle> copied = painted.first(pictures_[k].copied);
        const std::span<const PixelRectangle> drawn = painted.subspan(pictures_[k].copied);
        if (!copied.empty()) {
            glBindTexture(GL_TEXTURE_2D, texture_of_framebuffer());
            upload(copied, plan.picture.viewport);
        }
        // One draw serves all faces: their pixels are disjoint, and the light is already applied.
        const auto shown = std::find_if(plan.draws.begin(), plan.draws.end(), [k](const scene::Draw& draw) {
            return draw.shader.pass == scene::ShaderKey::Pass::Raster && draw.relief_draw == k;
        });
        const Shader* const shader = shown != plan.draws.end() ? shaders.find(shown->shader) : nullptr;
        if (shader == nullptr || drawn.empty()) {
            continue;
        }
        shader->use();
        glUniform4f(shader->location(Uniform::PixelFromFragment), 1.0F, 1.0F,
                    static_cast<float>(-plan.picture.viewport.x),
                    static_cast<float>(-plan.picture.viewport.y));
        glUniform2f(shader->location(Uniform::Dither), shown->dither.share,
                    shown->dither.complement ? 0.0F : 1.0F);
        glBindTexture(GL_TEXTURE_2D, pictures_[k].texels.get());
        shader->draw_rectangles({plan.projector.width, plan.projector.height}, drawn);
        ++calls;
    }
    glBindVertexArray(0);
    return calls;
}

std::uint64_t RasterPass::bytes() const {
    return std::accumulate(
        pictures_.begin(), pictures_.end(), std::uint64_t{0},
        [](std::uint64_t sum, const Picture& picture) { return sum + bytes_of_texture(picture.texels); });
}

} // namespace frustumscreen::render
