/// Draws the plan's quadrilaterals on the table, in order: first captions and pictures, then the prop's faces
/// in black, which hide them on the prop, then the pictures with `on_prop`. Where pictures overlap, the
/// brighter one shows.
///
/// It draws into the bound framebuffer, and leaves the scissor test and GL_FRAMEBUFFER_SRGB_EXT off.
///
/// Colour   linear light, which the framebuffer encodes.
/// Threads  the render thread; allocates nothing in `draw`.
#pragma once

#include "app/render/gpu_store.h"
#include "app/render/raster.h"
#include "app/render/shader_cache.h"
#include "app/scene/frame_plan.h"
#include "firmware_host/gl/gl_handle.h"

namespace frustumscreen::render {

class TablePass {
public:
    /// Returns the number of draw calls. `within`: nothing outside it is drawn. It skips draws whose shader
    /// was not prepared, or whose texture is not in the store.
    int draw(const scene::FramePlan& plan, const PixelRectangle& within, const GpuStore& store,
             const ShaderCache& shaders, const Raster& raster = {}) const;

private:
    gl::GlVertexArray no_attributes_ = gl::GlVertexArray::generate();
};

} // namespace frustumscreen::render
