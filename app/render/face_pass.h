/// Draws the meshes in the prop, and the reliefs whose triangles the GPU makes: the plan's faces into the stencil, then its draws on them, in order.
///
/// It draws into the framebuffer that is bound; the caller clears. It sets every piece of state that it
/// needs, the scissor to each draw's bounds, and leaves stencil test, depth test and culling off.
///
/// Colour   sRGB codes in and out: the framebuffer must take them as they are (GL_FRAMEBUFFER_SRGB_EXT off).
///          Decoding and encoding every sample costs a software GPU more than the rest of it.
/// Threads  the render thread; `draw` allocates nothing for meshes, and for reliefs as BlockInstances.
#pragma once

#include "app/render/block_instances.h"
#include "app/render/gpu_store.h"
#include "app/render/raster.h"
#include "app/render/shader_cache.h"
#include "app/scene/frame_plan.h"
#include "firmware_host/gl/gl_handle.h"

namespace frustumscreen {

class FacePass {
public:
    enum class Output {
        Colours,
        Places ///< prop coordinates, metres; alpha 1
    };
    /// Whether the plan has something that it draws.
    [[nodiscard]] static bool draws(const FramePlan& plan);
    /// Returns the number of draw calls. It leaves out casts, draws whose shader was not prepared, and those whose mesh or
    /// texture is not in the store.
    int draw(const FramePlan& plan, const GpuStore& store, const ShaderCache& shaders,
             const Raster& raster = {}, Output output = Output::Colours);

private:
    void upload_indices(const FramePlan& plan) const;
    void mark_faces(const FramePlan& plan, const Shader& outline, const Raster& raster) const;
    /// Returns the number of draw calls.
    int soften_edges(const FramePlan& plan, const ShaderCache& shaders, const Raster& raster) const;
    /// Sets all that a mesh and a relief share.
    void begin_surface(const FramePlan& plan, const Draw& draw, const GpuStore::Texture& texture,
                       const Shader& shader, const Raster& raster) const;
    void draw_mesh(const Draw& draw, const GpuStore::Mesh& mesh) const;

    BlockInstances blocks_;
    GlVertexArray no_attributes_ = GlVertexArray::generate();
    GlBuffer indices_ = GlBuffer::generate(); ///< the plan's, renewed with each picture
};

} // namespace frustumscreen
