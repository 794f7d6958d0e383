/// The views of torches: a small picture with depth for each, from which their light's shadows come.
///
/// Threads  the render thread; `see` allocates nothing, except the first time that it rasterizes.
/// Errors   the driver is out of memory.
#pragma once

#include "app/render/face_pass.h"
#include "app/render/gpu_store.h"
#include "app/render/raster_pass.h"
#include "app/render/shader_cache.h"
#include "app/render/torch_uniforms.h"
#include "app/scene/frame_plan.h"
#include "app/torch/shadow_map.h"
#include "firmware_host/base/result.h"
#include "firmware_host/gl/gl_handle.h"

#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen::render {

class TorchPass {
public:
    /// The rectangle around all pixels that the plan's torches light.
    [[nodiscard]] static PixelRectangle lit_by(const scene::FramePlan& plan);

    /// Makes the pictures if plans may have torches.
    [[nodiscard]] Result<void> prepare(const scene::RenderNeeds& needs);
    /// Makes the view of each of the plan's torches. `painted`: the rasterized parts of the plan's own picture, which are lit here if
    /// they are lit on the processor. Returns the number of draw calls.
    int see(const scene::FramePlan& plan, const GpuStore& store, const ShaderCache& shaders,
            RasterPass& painted);
    /// One for each of the plan's torches, since `see`.
    [[nodiscard]] std::span<const TorchPicture> pictures() const { return pictures_; }

    /// Light of the plan's torches, except layers, on samples that were averaged into the bound framebuffer, by each sample's depth.
    /// `averaged`: their layout in the larger picture, whose depth is the texture `depths`. Returns the number of draw calls.
    int light_samples(const Lit& lit, const Raster& averaged, unsigned depths) const;
    /// The same on the pixels of the bound framebuffer, whose colour and depth are textures.
    int light_pixels(const Lit& lit) const;

    /// Bytes of GPU memory, as the driver reports.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    struct Target {
        gl::GlFramebuffer framebuffer; ///< of `drawn_depth_` and `colour`
        gl::GlTexture colour;
        gl::GlTexture depth;    ///< shadow map that the GPU has drawn
        gl::GlTexture nearness; ///< shadow map that the processor has drawn
    };
    [[nodiscard]] Result<void> make_targets();
    /// Finds the nearness of the surfaces in some tiles of the torch's view, on the processor.
    void rasterize_view(const scene::TorchLight& light, const scene::FramePlan& view,
                        const relief::TileMask& asked, const GpuStore& store);
    /// Copies what lies within the bounds of the shadow map into the target's texture.
    void upload_shadow(const PixelRectangle& bounds, const Target& target);
    /// Draws the torch's view, with or without colours; or the depths of the surfaces that face away from it. Returns the number
    /// of draw calls.
    int draw_view(const scene::FramePlan& view, const Target& target, const GpuStore& store,
                  const ShaderCache& shaders, bool colours, relief::Facing facing = relief::Facing::Eye);

    /// Makes the shadow map of the drawn view. Returns the number of draw calls.
    int find_farthest(const scene::TorchLight& light, const Target& target, const ShaderCache& shaders,
                      bool has_backs) const;

    gl::GlTexture drawn_depth_, drawn_backs_; ///< of one torch after the other
    std::vector<Target> targets_;             ///< empty: there are no torches
    std::vector<TorchPicture> pictures_;
    FacePass faces_;
    RasterPass rasters_;
    torch::ShadowMap shadow_map_;
    gl::GlFramebuffer farthest_ = gl::GlFramebuffer::generate();
    gl::GlFramebuffer colour_alone_ = gl::GlFramebuffer::generate(); ///< so that the depth may be asked
    gl::GlVertexArray no_attributes_ = gl::GlVertexArray::generate();
};

} // namespace frustumscreen::render
