#include "app/render/sample_grid.h"

#include "app/render/gl_memory.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::render {

namespace {

glm::ivec2 size_of(const scene::LitTiles& tiles) {
    return {tiles.picture().width, tiles.picture().height};
}

} // namespace

glm::ivec2 SampleGrid::of(int samples) {
    switch (samples) {
    case 1:
        return {1, 1};
    case 2:
        return {1, 2};
    case 4:
        return {2, 2};
    case 8:
        return {2, 4};
    case 16:
        return {4, 4};
    default:
        return {0, 0};
    }
}

Result<SampleGrid> SampleGrid::create(const PixelSize& part, int max_samples) {
    const glm::ivec2 grid = of(max_samples);
    if (grid.x == 0) {
        return fail(ErrorKind::BadConfiguration, "render.samples",
                    "render: {} samples a pixel; allowed are 1, 2, 4, 8 and 16", max_samples);
    }
    SampleGrid made;
    made.size_ = grid * glm::ivec2(part.width, part.height);
    TRY_VOID(made.make_target());
    made.no_attributes_ = gl::GlVertexArray::generate();
    return made;
}

Result<void> SampleGrid::make_target() {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, &largest_viewport_.x);
    if (std::max(size_.x, size_.y) > most) {
        return fail(ErrorKind::BadConfiguration, "render.samples_too_wide",
                    "render: {} x {} samples; this driver draws up to {} on each side: "
                    "use fewer samples",
                    size_.x, size_.y, most);
    }
    framebuffer_ = gl::GlFramebuffer::generate();
    colour_ = gl::GlTexture::generate();
    depth_stencil_ = gl::GlTexture::generate();
    glBindTexture(GL_TEXTURE_2D, colour_.get());
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_SRGB8_ALPHA8, size_.x, size_.y);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_2D, depth_stencil_.get());
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH24_STENCIL8, size_.x, size_.y);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_.get(), 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, depth_stencil_.get(),
                           0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE || glGetError() != GL_NO_ERROR) {
        return fail(ErrorKind::BadConfiguration, "render.no_size_for_samples",
                    "render: the driver cannot hold {} x {} samples; use 1 sample a pixel", size_.x, size_.y);
    }
    // Averaging also reads some samples next to the tiles that a frame clears, so all are written once here.
    glDisable(GL_SCISSOR_TEST);
    glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    glFinish();
    return {};
}

std::uint64_t SampleGrid::bytes() const {
    return bytes_of_texture(colour_) + bytes_of_texture(depth_stencil_);
}

void SampleGrid::draw_tiles(const scene::LitTiles& tiles, const Shader& shader) const {
    glBindVertexArray(no_attributes_.get());
    shader.draw_rectangles(size_of(tiles), tiles.rectangles());
    glBindVertexArray(0);
}

Raster SampleGrid::raster(const PixelSize& picture, const PixelRectangle& lit, const PixelRectangle& around,
                          int samples) const {
    const auto fits = [&](const PixelRectangle& part, const glm::ivec2& grid) {
        return glm::all(glm::lessThanEqual(glm::ivec2(part.width, part.height) * grid, size_)) &&
               glm::all(
                   glm::lessThanEqual(glm::ivec2(picture.width, picture.height) * grid, largest_viewport_));
    };
    const bool inside = intersected(lit, around) == lit;
    for (; samples > 1; samples /= 2) {
        const glm::ivec2 upright = of(samples);
        for (const glm::ivec2& grid : {upright, glm::ivec2(upright.y, upright.x)}) {
            if (inside && fits(around, grid)) {
                return {grid, {around.x, around.y}};
            }
            if (fits(lit, grid)) {
                return {grid, {lit.x, lit.y}};
            }
        }
    }
    return {};
}

void SampleGrid::begin(const scene::LitTiles& tiles, const Raster& raster, const ShaderCache& shaders) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    set_viewport(size_of(tiles), raster);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glDepthMask(GL_TRUE);
    glEnable(GL_STENCIL_TEST);
    glStencilMask(0xFF);
    glStencilFunc(GL_ALWAYS, 0, 0xFF);
    glStencilOp(GL_REPLACE, GL_REPLACE, GL_REPLACE);
    if (const Shader* const clear = shaders.find({scene::ShaderKey::Pass::TileClear})) {
        clear->use();
        draw_tiles(tiles, *clear);
    }
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_DEPTH_TEST);
}

void SampleGrid::clear_depth(const PixelRectangle& part, const Raster& raster) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    glEnable(GL_SCISSOR_TEST);
    set_scissor(part, raster);
    glDepthMask(GL_TRUE);
    glClearDepthf(1.0F);
    glClear(GL_DEPTH_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
}

void SampleGrid::average(const scene::LitTiles& tiles, const Raster& raster, const glm::ivec2& viewport,
                         const ShaderCache& shaders) const {
    const bool many = raster.fragments.x * raster.fragments.y > 4;
    const Shader* const average =
        shaders.find({many ? scene::ShaderKey::Pass::TileAverageMany : scene::ShaderKey::Pass::TileAverage});
    if (average == nullptr) {
        return;
    }
    average->use();
    const glm::ivec2 corner = raster.corner + viewport;
    glUniform4i(average->location(Uniform::Raster), raster.fragments.x, raster.fragments.y, corner.x,
                corner.y);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, colour_.get());
    draw_tiles(tiles, *average);
}

} // namespace frustumscreen::render
