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
#include "app/scene/frame_plan.h"
#include "firmware_host/base/result.h"

#include <array>
#include <optional>

namespace frustumscreen {

/// What pictures are drawn with unless someone asks for another number.
/// What a pack may ask for: the live exhibit has room for it.
inline constexpr int default_samples = 8;
/// For those who do not count the cost: the finest level.
inline constexpr int finest_samples = 16;

struct RendererOptions {
    int width = 0;
    int height = 0;
    /// Samples a pixel, on a regular grid, averaged in linear light: 1, 2, 4, 8 or 16. More smooth the
    /// outlines and the texture. The artifact's rectangle alone is drawn larger and averaged down: on
    /// llvmpipe that takes half the time of the driver's own multisampling.
    int samples = default_samples; ///< the most; a plan may ask for fewer, and for more where there is room
    bool level_fades = false;      ///< a plan may fade from one level to another
    bool plain = true;             ///< a plan may leave the light as it is
    bool compensated = true;       ///< a plan may even it out
    bool captions = true;          ///< a plan may have one
    bool cut_out = false;          ///< an artifact may have texels that are cut out
};

[[nodiscard]] inline RendererOptions options_of(const PassNeeds& needs, int width, int height) {
    return {width,          height,       needs.samples, needs.level_fades, needs.plain, needs.compensated,
            needs.captions, needs.cut_out};
}

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
    [[nodiscard]] static Result<Renderer> create(const RendererOptions& options);

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

    /// The programs that were made.
    [[nodiscard]] std::vector<Program> programs() const;
    /// Of GPU memory, as the driver says, but for the indices that come with each picture.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    struct Picture {
        std::uint64_t hash = 0;
        PixelRectangle bounds;
    };
    explicit Renderer(FacePass pass) : pass_(std::move(pass)) {}
    void paint(const FramePlan& plan, const Shows& shows, const RenderTarget& target,
               DrawResult& result) const;
    void draw_caption(const FramePlan& plan, const Shows& shows, const PixelRectangle& part,
                      const Raster& raster, DrawResult& result) const;
    [[nodiscard]] PixelRectangle to_redraw(const FramePlan& plan, const RenderTarget& target,
                                           Redraw redraw) const;

    RendererOptions options_;
    FacePass pass_;
    std::optional<CaptionPass> caption_;
    std::optional<SampleGrid> sample_grid_; ///< for more than one sample
    std::array<Picture, 4> history_{};      ///< [0] is the last picture presented
    std::size_t pictures_ = 0;              ///< valid entries of history_
};

} // namespace frustumscreen
