#include "app/render/hit_points.h"

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace frustumscreen::render {

Result<HitPointRenderer> HitPointRenderer::create(const Renderer& shown) {
    const int width = shown.width();
    const int height = shown.height();
    HitPointRenderer renderer(width, height);
    std::set<scene::ShaderKey> shaders{{scene::ShaderKey::Pass::Outline}};
    for (const scene::ShaderKey& key : shown.shaders()) {
        if (key.pass == scene::ShaderKey::Pass::Surface) {
            shaders.insert(scene::places_of(key));
        }
    }
    TRY_VOID(renderer.shaders_.prepare(shaders, shown.bent_by()));
    renderer.framebuffer_ = gl::GlFramebuffer::generate();
    renderer.points_ = gl::GlRenderbuffer::generate();
    renderer.depth_stencil_ = gl::GlRenderbuffer::generate();
    glBindFramebuffer(GL_FRAMEBUFFER, renderer.framebuffer_.get());
    glBindRenderbuffer(GL_RENDERBUFFER, renderer.points_.get());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA32F, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, renderer.points_.get());
    glBindRenderbuffer(GL_RENDERBUFFER, renderer.depth_stencil_.get());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                              renderer.depth_stencil_.get());
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        return fail(
            ErrorKind::BadConfiguration, "render.no_float_pictures",
            "render: this driver cannot draw into float pictures (EXT_color_buffer_float); leave out --aov");
    }
    return renderer;
}

image::ImageFloat HitPointRenderer::draw(const scene::FramePlan& plan, const GpuStore& store) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    glViewport(0, 0, width_, height_);
    glDisable(GL_SCISSOR_TEST);
    constexpr std::array<float, 4> nothing{0.0F, 0.0F, 0.0F, 0.0F};
    glStencilMask(0xFF);
    glClearBufferfv(GL_COLOR, 0, nothing.data());
    glClearBufferfi(GL_DEPTH_STENCIL, 0, 1.0F, 0);
    pass_.draw(plan, store, shaders_, {}, FacePass::Output::Places);
    image::ImageFloat image(width_, height_);
    std::vector<glm::vec4> read(image.texels.size());
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, read.data());
    for (std::size_t k = 0; k < read.size(); ++k) {
        image.texels[k] =
            read[k].a > 0.5F ? glm::vec3(read[k]) : glm::vec3(std::numeric_limits<float>::quiet_NaN());
    }
    add_rasters(plan, store, image);
    return image;
}

void HitPointRenderer::add_rasters(const scene::FramePlan& plan, const GpuStore& store,
                                   image::ImageFloat& points) {
    for (std::size_t relief_draw = 0; relief_draw < plan.relief_draw_count; ++relief_draw) {
        const scene::ReliefDraw& planned = plan.relief_draws[relief_draw];
        const relief::BlockRelief* const relief =
            planned.on_gpu ? nullptr : store.find_relief(planned.relief);
        if (relief == nullptr) {
            continue;
        }
        image::ImageFloat met(width_, height_);
        painter_->hit_points(
            {.relief = relief, .view = &planned.view, .dither = planned.dither},
            {.first = met.texels.data(), .width = width_, .height = height_, .stride = width_});
        const auto in_prop = [&](const glm::dvec3& box) {
            return glm::dvec3(planned.prop_from_box * glm::dvec4(box, 1.0));
        };
        const glm::dvec3 eye = in_prop(planned.view.eye_box);
        for (std::size_t k = 0; k < points.texels.size(); ++k) {
            glm::vec3& nearest = points.texels[k];
            const glm::dvec3 point = in_prop(met.texels[k]);
            if (std::isnan(nearest.x) ||
                glm::distance(point, eye) < glm::distance(glm::dvec3(nearest), eye)) {
                nearest = point;
            }
        }
    }
}

} // namespace frustumscreen::render
