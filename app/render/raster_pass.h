/// Reliefs rasterized on the processor, as one picture in the GPU's memory.
///
/// Lit rectangles without other content are copied into the picture; under others it is drawn, pixel by pixel. Where a
/// mesh or a relief of the GPU may hide it or be hidden by it, it is drawn among them by depth. GL state as in FacePass.
///
/// Colour   sRGB codes, in the projector's light (scene/raster_light.h); alpha 0 where no surface was hit.
/// Threads  the render thread, with one thread of its own for each further core. `paint` allocates nothing
///          once it has painted a picture as full, and makes no GL object.
/// Errors   the driver is out of memory.
#pragma once

#include "app/image/image.h"
#include "app/relief/relief_painter.h"
#include "app/render/gpu_store.h"
#include "app/render/nearness_tiles.h"
#include "app/render/point_painter.h"
#include "app/render/raster.h"
#include "app/render/relief_light.h"
#include "app/render/shader_cache.h"
#include "app/render/torch_uniforms.h"
#include "app/scene/frame_plan.h"
#include "app/scene/raster_light.h"
#include "firmware_host/base/pixel_rectangle.h"
#include "firmware_host/base/result.h"
#include "firmware_host/gl/gl_handle.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace frustumscreen::render {

class RasterPass {
public:
    /// Allocates what the needs' reliefs take: a picture as large as the whole picture, and its depth.
    [[nodiscard]] Result<void> prepare(const scene::RenderNeeds& needs, int width, int height);

    enum class Depth { WhereItMeets, Everywhere };
    enum class Rectangles { MayBeCopied, AreDrawn };
    /// Rasterizes the plan's reliefs in the store that the GPU does not draw; a plan of points has nothing else. Everywhere:
    /// `show_in_depth` shows all of it. AreDrawn: `show` draws pixel by pixel, and keeps the picture where no relief is.
    void paint(const scene::FramePlan& plan, const GpuStore& store, Depth depth = Depth::WhereItMeets,
               Rectangles rectangles = Rectangles::MayBeCopied, relief::Facing facing = relief::Facing::Eye);
    /// Draws those parts of the painted reliefs that meet the GPU's draws, into the bound framebuffer, in which FacePass
    /// has drawn them; returns the number of draw calls.
    int show_in_depth(const scene::FramePlan& plan, const ShaderCache& shaders, const Raster& raster) const;
    /// Shows the other parts in the bound framebuffer, whose colour must be a texture; returns the number of draw calls.
    int show(const scene::FramePlan& plan, const ShaderCache& shaders) const;

    /// After `show`: blends points that take only a share of each pixel's light over what is drawn in the plan's face; returns the
    /// number of draw calls.
    int blend_points(const scene::FramePlan& plan, const ShaderCache& shaders);

    /// Call it after `paint`: finds which parts of what `show` shows the plan's torches light. Uploads what their
    /// light takes on the GPU.
    void find_lit_parts(const scene::FramePlan& plan);
    /// After `find_lit_parts`. True: call `light_here` for each torch, in order, instead of `light`.
    [[nodiscard]] bool lights_here() const { return lights_here_; }
    /// A torch's plain light on these parts, in main memory. `shadow`: as PlainLight::shadow.
    void light_here(const scene::FramePlan& plan, std::size_t torch, const torch::ShadowMap* shadow);
    /// The tiles of a torch's own picture whose depths these parts need.
    [[nodiscard]] const relief::TileMask& asked_of(std::size_t torch) const { return asked_[torch]; }

    /// Light of the plan's torches: of those that show layers, on what `show_in_depth` has drawn; of all, on what `show` has. Each returns
    /// the number of draw calls.
    int light_layers_in_depth(const Lit& lit);
    int light(const Lit& lit) const;

    /// Instead of `paint`: the nearness alone, into memory (relief::ReliefPainter::paint_nearness).
    void paint_nearness(const scene::FramePlan& plan, const GpuStore& store, const relief::TileMask& asked,
                        const relief::PictureSpan<float>& nearness,
                        relief::Facing facing = relief::Facing::Eye);

    /// Bytes of GPU memory, as the driver reports.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    /// From main memory into the eye's viewport in a texture.
    struct Upload {
        unsigned format = 0, type = 0;
        const void* texels = nullptr;
        int bytes_of_texel = 0, width = 0; ///< in main memory
    };
    static void upload(const Upload& from, std::span<const PixelRectangle> parts,
                       const PixelRectangle& viewport);
    [[nodiscard]] Upload colours() const;
    [[nodiscard]] Upload depths() const;
    [[nodiscard]] Upload layers_of_torches() const;

    /// Paints points into memory, and returns where.
    [[nodiscard]] PixelRectangle paint_points(const scene::ReliefDraw& points);
    /// Paints the plan's points; false: it has none, or they are blended over the rest.
    [[nodiscard]] bool paint_points_alone(const scene::FramePlan& plan);
    void list_reliefs(const scene::FramePlan& plan, const GpuStore& store, relief::Facing facing);
    void find_meeting(const scene::FramePlan& plan);
    void find_lit(const scene::FramePlan& plan, const GpuStore& store);
    void begin_lighting() const;
    /// A torch on a draw, in those of `rectangles` that it may light.
    int light_rectangles(const scene::FramePlan& plan, const scene::TorchDraw& lit, const Shader& shader,
                         const Raster& raster, std::span<const PixelRectangle> rectangles);
    /// Sorts what was painted by the way in which it is shown.
    void add_painted(const scene::FramePlan& plan, const PixelRectangle& part, Rectangles rectangles);

    std::unique_ptr<relief::ReliefPainter> painter_; ///< null: no picture was prepared
    std::unique_ptr<PointPainter> points_;           ///< null: no points were painted
    scene::RasterLight light_;
    image::Image8 memory_;         ///< main memory that the reliefs are rasterized in
    image::Image<float> nearness_; ///< as large if there is depth, otherwise empty
    gl::GlTexture colour_texels_; ///< valid in the rectangles that are drawn; the rest is from earlier frames
    gl::GlTexture nearness_texels_;
    std::vector<relief::SeenRelief> seen_;
    std::vector<PixelRectangle> lit_;        ///< by torches
    std::vector<PixelRectangle> overlaid_;   ///< what was painted of it
    std::vector<PixelRectangle> rectangles_; ///< of one draw
    std::vector<LitParts> lit_parts_;        ///< the first ones are of FramePlan::torch_faces
    std::array<relief::TileMask, torch::max_torches> asked_{};
    ReliefLight plain_light_;
    bool lights_here_ = false;
    bool layered_ = false; ///< a torch shows other colours of what was painted
    image::Image8 layer_;  ///< what a torch shows in place of the reliefs' colours; empty: nothing yet
    gl::GlTexture layer_texels_;
    std::vector<PixelRectangle> meeting_; ///< where the GPU draws something at other depths
    std::vector<PixelRectangle> copied_, drawn_, in_depth_;
    gl::GlVertexArray no_attributes_ = gl::GlVertexArray::generate();
};

} // namespace frustumscreen::render
