/// Draws a plan into a display's framebuffer: only what changed, and nothing if nothing changed.
///
/// Colour   the framebuffer is sRGB (display.h); shaders work in linear light.
/// Threads  the render thread; `draw` allocates nothing and makes no GL object.
/// Errors   at creation only: shaders or buffers that the driver refuses.
#pragma once

#include "app/render/artifact_gpu.h"
#include "app/render/caption_pass.h"
#include "app/render/face_pass.h"
#include "app/render/sample_grid.h"
#include "app/render/shader_cache.h"
#include "app/scene/frame_plan.h"
#include "app/scene/shader_key.h"
#include "firmware_host/base/result.h"

#include <array>
#include <optional>
#include <set>

namespace frustumscreen {

/// Samples a pixel lie on a regular grid and are averaged in linear light: 1, 2, 4, 8 or 16. More smooth the
/// outlines and the texture. The artifact's rectangle alone is drawn larger and averaged down: on llvmpipe
/// that takes half the time of the driver's own multisampling.
///
/// What a pack may ask for: the live exhibit has room for it.
inline constexpr int default_samples = 8;
/// For those who do not count the cost: the finest level.
inline constexpr int finest_samples = 16;

/// Display::framebuffer and Display::buffer_age.
struct RenderTarget {
    unsigned framebuffer = 0;
    int buffer_age = 0;
};

struct DrawResult {
    bool drawn = false;     ///< false: the picture on show is still right; do not present
    PixelRectangle redrawn; ///< what was cleared and drawn
    PixelRectangle lit;     ///< every pixel that the picture may light
    int draw_calls = 0;
};

enum class Redraw {
    Changes,
    Again,      ///< to present it once more: as Changes, but `drawn` even if nothing had to be
    Everything, ///< the whole picture, whether it changed or not
};

class Renderer {
public:
    /// Of pictures of that size. Compiles every shader of the needs: no frame compiles one.
    [[nodiscard]] static Result<Renderer> create(int width, int height, const RenderNeeds& needs);

    /// What the plan shows. Neither is touched if the plan has no need of it.
    struct Shows {
        const ArtifactGpu* artifact = nullptr;
        const CaptionGpu* caption = nullptr;
        const ArtifactGpu* coming = nullptr; ///< the level that a fade brings in
    };
    /// Each drawn picture must be presented before the next call: the target's age counts presents.
    DrawResult draw(const FramePlan& plan, const ArtifactGpu* artifact, const RenderTarget& target,
                    Redraw redraw = Redraw::Changes) {
        return draw(plan, Shows{artifact, nullptr}, target, redraw);
    }
    DrawResult draw(const FramePlan& plan, const Shows& shows, const RenderTarget& target,
                    Redraw redraw = Redraw::Changes);

    /// Those that were compiled.
    [[nodiscard]] std::set<ShaderKey> shaders() const { return shaders_.keys(); }
    /// Of GPU memory, as the driver says, but for the indices that come with each picture.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    struct Picture {
        std::uint64_t hash = 0;
        PixelRectangle bounds;
    };
    Renderer(int width, int height) : width_(width), height_(height) {}
    void paint(const FramePlan& plan, const Shows& shows, const RenderTarget& target,
               DrawResult& result) const;
    void draw_caption(const FramePlan& plan, const Shows& shows, const PixelRectangle& part,
                      const Raster& raster, DrawResult& result) const;
    [[nodiscard]] PixelRectangle to_redraw(const FramePlan& plan, const RenderTarget& target,
                                           Redraw redraw) const;

    int width_, height_;
    int samples_ =
        1; ///< a pixel, that there is room for; a plan may ask for fewer, and for more of a smaller part
    ShaderCache shaders_;
    FacePass pass_ = FacePass::create();
    CaptionPass caption_ = CaptionPass::create();
    std::optional<SampleGrid> sample_grid_; ///< for more than one sample
    std::array<Picture, 4> history_{};      ///< [0] is the last picture presented
    std::size_t pictures_ = 0;              ///< valid entries of history_
};

} // namespace frustumscreen
