/// Makes several samples a pixel: it draws the artifact's part of the picture larger, then averages.
///
/// On a software GPU that takes half the time of the driver's own multisampling, and it smooths the texture
/// as well as the outlines.
///
/// Colour   averaged in linear light.
/// Threads  the render thread; `begin` and `average` allocate nothing. Their shaders have been prepared.
/// Errors   a number of samples that has no grid; a picture larger than the driver draws.
#pragma once

#include "app/render/raster.h"
#include "app/render/shader_cache.h"
#include "app/scene/lit_tiles.h"
#include "firmware_host/base/result.h"
#include "firmware_host/gl/gl_handle.h"

#include <glm/glm.hpp>

namespace frustumscreen {

class SampleGrid {
public:
    /// Has room for `most_samples` a pixel, 2, 4, 8 or 16, in a part of the picture of that size; a smaller part may have more,
    /// a larger one has fewer.
    [[nodiscard]] static Result<SampleGrid> create(const PixelSize& picture, const PixelSize& part,
                                                   int most_samples);

    /// Samples along a pixel's sides; zero for a number that has no grid.
    [[nodiscard]] static glm::ivec2 of(int samples);

    /// How what is lit lies in the larger picture, with `samples` a pixel or as many as there is room for; one, and then nothing is
    /// to be drawn larger, if there is no room at all. `around`: what the place is taken from if there is room for all of it, since
    /// fragments elsewhere round differently, and pictures of one pose shall not depend on what a level lights.
    [[nodiscard]] Raster raster(const PixelRectangle& lit, const PixelRectangle& around, int samples) const;
    /// Binds the larger picture and clears the tiles in it: black, far, stencil 0.
    void begin(const LitTiles& tiles, const Raster& raster, const ShaderCache& shaders) const;
    /// Averages the tiles into the framebuffer that is bound, which encodes linear light.
    void average(const LitTiles& tiles, const Raster& raster, const ShaderCache& shaders) const;

    /// Bytes of GPU memory, as the driver says.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    SampleGrid() = default;
    [[nodiscard]] Result<void> make_target();
    void draw_tiles(const LitTiles& tiles, const Shader& shader) const;

    glm::ivec2 picture_{0, 0};
    glm::ivec2 room_{0, 0}; ///< of the larger picture, in fragments
    glm::ivec2 largest_viewport_{0, 0};
    GlFramebuffer framebuffer_;
    GlTexture colour_;
    GlRenderbuffer depth_stencil_;
    GlVertexArray no_attributes_;
};

} // namespace frustumscreen
