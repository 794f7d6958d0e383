/// Draws the meshes in the prop, and the reliefs that the GPU draws: marks the plan's faces in the stencil,
/// then draws on them, in order.
///
/// It draws into the bound framebuffer and viewport; the caller clears both. It sets every other piece of GL state that
/// it needs, and the scissor to each draw's bounds; it leaves stencil test, depth test and culling off.
///
/// Colour   sRGB codes in and out: the framebuffer must store them unchanged (GL_FRAMEBUFFER_SRGB_EXT off).
///          Decoding and encoding every sample costs a software GPU more than all other work.
/// Threads  the render thread. `draw` allocates nothing for meshes; for reliefs, as BlockInstances.
#pragma once

#include "app/render/block_instances.h"
#include "app/render/gpu_store.h"
#include "app/render/raster.h"
#include "app/render/shader_cache.h"
#include "app/render/torch_uniforms.h"
#include "app/scene/frame_plan.h"
#include "firmware_host/gl/gl_handle.h"

#include <span>

namespace frustumscreen::render {

/// Draws a convex polygon, filled. Returns the number of draw calls.
int draw_outline(std::span<const glm::vec4> corners, const Shader& shader);

class FacePass {
public:
    enum class Output {
        Colours,
        Places ///< prop coordinates, metres; alpha 1
    };
    /// True if the plan has draws for this pass.
    [[nodiscard]] static bool draws(const scene::FramePlan& plan);
    /// Returns the number of draw calls. It skips reliefs rasterized on the processor, draws whose shader was
    /// not prepared, and draws whose mesh or texture is not in the store. Facing::Away draws the back-facing
    /// surfaces that the plan has.
    int draw(const scene::FramePlan& plan, const GpuStore& store, const ShaderCache& shaders,
             const Raster& raster = {}, Output output = Output::Colours,
             relief::Facing facing = relief::Facing::Eye);

    /// Marks the plan's faces in the stencil, all but what covers them, as `draw` does before it draws.
    void mark(const scene::FramePlan& plan, const ShaderCache& shaders, const Raster& raster) const;

    /// The plan's torches that show layers, on the meshes and blocks that `draw` has just drawn there. Returns the number of
    /// draw calls.
    int light_layers(const Lit& lit) const;

private:
    /// Returns the number of draw calls: 0 if something is missing.
    int light_draw(const Lit& lit, const scene::TorchDraw& draw) const;
    void upload_indices(const scene::FramePlan& plan) const;
    void mark_faces(const scene::FramePlan& plan, const Shader& outline, const Raster& raster) const;
    /// Returns the number of draw calls.
    int soften_edges(const scene::FramePlan& plan, const ShaderCache& shaders, const Raster& raster) const;
    /// Sets the state that a mesh and a relief share.
    void begin_surface(const scene::FramePlan& plan, const scene::Draw& draw,
                       const GpuStore::Texture& texture, const Shader& shader, const Raster& raster) const;
    void draw_mesh(const scene::Draw& draw, const scene::IndexRange& range, const GpuStore::Mesh& mesh) const;

    BlockInstances blocks_;
    gl::GlVertexArray no_attributes_ = gl::GlVertexArray::generate();
    gl::GlBuffer indices_ = gl::GlBuffer::generate(); ///< the plan's indices, refilled for each picture
};

} // namespace frustumscreen::render
