#include "app/render/table_pass.h"

#include <GLES2/gl2ext.h>
#include <glm/gtc/type_ptr.hpp>

namespace frustumscreen::render {

int TablePass::draw(const scene::FramePlan& plan, const PixelRectangle& within, const GpuStore& store,
                    const ShaderCache& shaders, const Raster& raster) const {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_CULL_FACE);
    glBlendEquation(GL_MAX);
    glEnable(GL_FRAMEBUFFER_SRGB_EXT);
    glEnable(GL_SCISSOR_TEST);
    glActiveTexture(GL_TEXTURE0);
    glBindVertexArray(no_attributes_.get());
    int calls = 0;
    for (const scene::Draw& draw : plan.draws) {
        const PixelRectangle part = intersected(draw.bounds, within);
        const scene::TextureId picture = draw.drawable.material.texture;
        const GpuStore::Texture* const texture = store.find(picture);
        const Shader* const shader = shaders.find(draw.shader);
        if (draw.face != scene::Draw::on_table || part.empty() || shader == nullptr ||
            (texture == nullptr && picture != scene::TextureId::None)) {
            continue;
        }
        (picture != scene::TextureId::None ? glEnable : glDisable)(GL_BLEND);
        shader->use();
        // Black uses no texture: a driver would compile for the format of whichever was bound before.
        glBindTexture(GL_TEXTURE_2D, texture != nullptr ? texture->texels.get() : 0);
        set_scissor(part, raster);
        glUniform1f(shader->location(Uniform::Brightness), draw.brightness);
        glUniform4fv(shader->location(Uniform::Corners), 4, glm::value_ptr(draw.clip_from_unit));
        shader->draw_quad();
        ++calls;
    }
    glBindVertexArray(0);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_FRAMEBUFFER_SRGB_EXT);
    glDisable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    return calls;
}

} // namespace frustumscreen::render
