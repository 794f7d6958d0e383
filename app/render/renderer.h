/// Draws a plan into a display's framebuffer: only the changes, and nothing if nothing changed. Owns the
/// meshes and textures that plans name, and a program for each of their shaders.
///
/// Colour   the framebuffer is sRGB (display.h); shaders work in linear light.
/// Threads  the render thread; `draw` allocates nothing and makes no GL object.
/// Errors   on creation, preparation or upload: shaders, buffers or textures that the driver refuses.
#pragma once

#include "app/render/face_pass.h"
#include "app/render/gpu_store.h"
#include "app/render/raster_pass.h"
#include "app/render/sample_grid.h"
#include "app/render/shader_cache.h"
#include "app/render/table_pass.h"
#include "app/render/torch_pass.h"
#include "app/scene/frame_plan.h"
#include "app/scene/shader_key.h"
#include "firmware_host/base/result.h"

#include <array>
#include <optional>
#include <set>
#include <span>

namespace frustumscreen::render {

/// Samples a pixel lie on a regular grid and are averaged in linear light: 1, 2, 4, 8 or 16. More samples
/// smooth the outlines and the texture. Only the artifact's rectangle is drawn larger and averaged down: on
/// llvmpipe this takes half the time of the driver's own multisampling.
///
/// The live exhibit's render target holds this many for each pixel of the prop. An artifact that asks for more gets
/// them if it covers less of the picture than the prop; otherwise the samples are halved until the picture
/// fits.
inline constexpr int default_samples = 4;
/// For the finest level, if the cost does not matter.
inline constexpr int finest_samples = 16;

/// Display::framebuffer, whose colour is a texture, and Display::buffer_age.
struct RenderTarget {
    unsigned framebuffer = 0;
    int buffer_age = 0;
};

struct DrawResult {
    bool drawn = false;     ///< false: the picture on show is still valid; do not present
    PixelRectangle redrawn; ///< the part that was cleared and drawn
    PixelRectangle lit;     ///< every pixel that the picture may light
    int draw_calls = 0;
};

enum class Redraw {
    Changes,
    Again,      ///< to present it again: as Changes, but `drawn` is always true
    Everything, ///< the whole picture, even if unchanged
};

class Renderer {
public:
    /// Makes a renderer for pictures of this size.
    [[nodiscard]] static Result<Renderer> create(int width, int height, const scene::RenderNeeds& needs = {});
    /// Compiles and allocates whatever these needs add to the earlier ones, so that no frame compiles
    /// anything.
    [[nodiscard]] Result<void> prepare(const scene::RenderNeeds& needs);

    /// The meshes and textures that plans name. A picture counts as unchanged until its plan names something
    /// else; a released object is missing from the next picture that is drawn.
    [[nodiscard]] GpuStore& store() { return store_; }
    [[nodiscard]] const GpuStore& store() const { return store_; }

    /// Draws one plan for each eye, each in its part of the picture (scene/stereo.h); from call to call the same number
    /// of plans in the same parts. Each drawn picture must be presented before the next call: the target's age counts
    /// presents.
    DrawResult draw(std::span<const scene::FramePlan> plans, const RenderTarget& target,
                    Redraw redraw = Redraw::Changes);
    DrawResult draw(const scene::FramePlan& plan, const RenderTarget& target,
                    Redraw redraw = Redraw::Changes) {
        return draw(std::span(&plan, 1), target, redraw);
    }

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    /// The compiled shaders.
    [[nodiscard]] std::set<scene::ShaderKey> shaders() const { return shaders_.keys(); }
    /// The projector whose lens distortion the shaders apply, if any.
    [[nodiscard]] const std::optional<geometry::Pinhole>& bent_by() const { return needs_.bent_by; }
    /// Bytes of GPU memory, as the driver reports, without the indices that come with each picture.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    /// Each draw on the table is tracked by itself, so that a change of one redraws only that one.
    struct Picture {
        struct OnTable {
            std::uint64_t hash = 0;
            PixelRectangle bounds;
        };
        std::uint64_t hash = 0;
        std::uint64_t prop_hash = 0;
        PixelRectangle prop_bounds;
        /// Including the faces of prop and windows in black, and the windows' pictures.
        std::array<OnTable, scene::max_on_table + 16 + 2 * scene::max_windows> on_table{};
        std::size_t count = 0;
        [[nodiscard]] bool lies(const OnTable& draw) const;
        void add_changes(const Picture& other, PixelRectangle& changes) const;
    };
    struct Repaint {
        PixelRectangle part;    ///< of the eye's picture
        bool prop = true;       ///< false: the part does not touch the prop
        bool whole = false;     ///< the whole picture
        PixelRectangle clear{}; ///< of the display's picture; empty: the eye before has cleared the part
    };
    static constexpr std::size_t max_eyes = 2;
    using EyePictures = std::array<Picture, max_eyes>;
    [[nodiscard]] static Picture picture_of(const scene::FramePlan& plan);
    Renderer(int width, int height) : width_(width), height_(height) {}
    void paint(const scene::FramePlan& plan, const RenderTarget& target, const Repaint& repaint,
               DrawResult& result);
    /// The plan's windows that meet the part, which holds each of them whole.
    void paint_windows(const scene::FramePlan& plan, const RenderTarget& target, const PixelRectangle& part,
                       DrawResult& result);
    /// Draws a window of the plan into the bound target; returns the number of draw calls.
    int draw_window(const scene::FramePlan& window, const scene::FramePlan& plan, const RenderTarget& target,
                    const Raster& direct);
    /// The part of a window that the GPU draws, into the bound target, whose stencil then marks the window. `torches`: of the window.
    int draw_surfaces(const scene::FramePlan& window, const scene::FramePlan& plan,
                      std::span<const TorchPicture> torches, const RenderTarget& target,
                      const Raster& direct);
    /// Finds what each of the plan's torches sees, once what it rasterizes is painted. Returns the number of draw calls.
    int see_torches(const scene::FramePlan& plan);
    /// The plan's torches that show layers, on what has depth. Returns the number of draw calls.
    int light_layers(const Lit& lit);
    [[nodiscard]] Repaint to_redraw(const scene::FramePlan& plan, std::size_t eye, const Picture& picture,
                                    const RenderTarget& target, Redraw redraw) const;
    /// Widens a part until it holds the prop and each window of these pictures either whole or not at all.
    static void include_touched(std::span<const scene::FramePlan> plans, std::span<const Picture> pictures,
                                Repaint& repaint);
    /// Clears two whole pictures at once: a driver on the processor clears a part of a framebuffer, or some of its
    /// colours, as it draws, which takes several times as long. Eyes in the same pixels are redrawn together, so that one
    /// clear serves both.
    void share_clears(std::span<const scene::FramePlan> plans, const EyePictures& pictures,
                      std::array<Repaint, max_eyes>& repaints) const;
    [[nodiscard]] bool shows(std::span<const scene::FramePlan> plans) const;

    int width_, height_;
    /// Space for the largest number of samples; a plan may ask for fewer, and for more in a smaller part.
    scene::RenderNeeds needs_;
    GpuStore store_;
    ShaderCache shaders_;
    RasterPass raster_pass_;
    FacePass faces_;
    TablePass table_;
    std::optional<TorchPass> torches_;      ///< if plans may have torches
    std::optional<SampleGrid> sample_grid_; ///< for more than one sample a pixel
    std::array<EyePictures, 4> history_{};  ///< [0] is the last picture presented
    std::size_t pictures_ = 0;              ///< valid entries of history_
};

} // namespace frustumscreen::render
