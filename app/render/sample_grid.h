/// Several samples a pixel: the artifact's part of the picture is drawn larger, then averaged.
///
/// On a software GPU this takes half the time of the driver's own multisampling, and it smooths the texture
/// as well as the outlines.
///
/// Colour   averaged in linear light.
/// Threads  the render thread; `begin` and `average` allocate nothing. Their shaders must be prepared.
/// Errors   a number of samples without a grid; a picture beyond the driver's limit.
#pragma once

#include "app/render/raster.h"
#include "app/render/shader_cache.h"
#include "app/scene/lit_tiles.h"
#include "firmware_host/base/result.h"
#include "firmware_host/gl/gl_handle.h"

#include <glm/glm.hpp>

namespace frustumscreen::render {

class SampleGrid {
public:
    /// Allocates memory for `max_samples` a pixel, 2, 4, 8 or 16, in a part of a picture of this size; a
    /// smaller part may have more, a larger one has fewer.
    [[nodiscard]] static Result<SampleGrid> create(const PixelSize& part, int max_samples);

    /// Samples along a pixel's sides; zero for a number without a grid.
    [[nodiscard]] static glm::ivec2 of(int samples);

    /// The layout of the lit part of a picture of this size in the larger picture, with `samples` a pixel or as many as fit; 1 x 1 if
    /// not even two fit, and then nothing is drawn larger. `around`: if all of it fits, the layout is based
    /// on it instead of on `lit`. Fragments round differently at other positions, and pictures of one pose
    /// must not depend on what a level lights.
    [[nodiscard]] Raster raster(const PixelSize& picture, const PixelRectangle& lit,
                                const PixelRectangle& around, int samples) const;
    /// Binds the larger picture and clears the tiles in it: black, far, stencil 0.
    void begin(const scene::LitTiles& tiles, const Raster& raster, const ShaderCache& shaders) const;
    /// Clears the depth in a part of the picture, also beside the tiles. After `begin`, before anything is drawn.
    void clear_depth(const PixelRectangle& part, const Raster& raster) const;
    /// Averages the tiles into the bound framebuffer, which encodes linear light, and its viewport, whose first
    /// pixel is `viewport`.
    void average(const scene::LitTiles& tiles, const Raster& raster, const glm::ivec2& viewport,
                 const ShaderCache& shaders) const;

    /// The texture of the larger picture's depth.
    [[nodiscard]] unsigned depths() const { return depth_stencil_.get(); }

    /// Bytes of GPU memory, as the driver reports.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    SampleGrid() = default;
    [[nodiscard]] Result<void> make_target();
    void draw_tiles(const scene::LitTiles& tiles, const Shader& shader) const;

    glm::ivec2 size_{0, 0}; ///< of the larger picture, in fragments
    glm::ivec2 largest_viewport_{0, 0};
    gl::GlFramebuffer framebuffer_;
    gl::GlTexture colour_;
    gl::GlTexture depth_stencil_;
    gl::GlVertexArray no_attributes_;
};

} // namespace frustumscreen::render
